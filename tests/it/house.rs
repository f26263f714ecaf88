//! The house itself: what `src` must look like for the module map to stay true.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The floors, lowest first; a module imports from its own floor and from those below.
const FLOORS: [(&str, u32); 11] = [
    ("math", 0),
    ("store", 0),
    ("compute", 0),
    ("shape", 1),
    ("body", 2),
    ("joint", 2),
    ("collision", 3),
    ("resolution", 4),
    ("world", 5),
    ("report", 6),
    // Only in unit tests.
    ("testing", 0),
];

const LONGEST_FILE: usize = 500;

/// One source file: its path from `src`, with forward slashes, and its text.
struct Source {
    path: String,
    text: String,
}

fn floor_of(module: &str) -> Option<u32> {
    FLOORS.iter().find(|(name, _)| *name == module).map(|&(_, floor)| floor)
}

impl Source {
    fn new(path: &str, text: &str) -> Self {
        Self { path: path.into(), text: text.into() }
    }

    /// The module of the crate root that the file belongs to; none for `lib.rs`.
    fn module(&self) -> &str {
        self.path.split(['/', '.']).next().unwrap_or_default()
    }

    /// A file that is compiled for tests only.
    fn is_test(&self) -> bool {
        self.path.split(['/', '.']).any(|part| part == "tests" || part == "testing")
    }

    /// The lines that are neither comments nor within a `#[cfg(test)]` module, with their numbers.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        let mut waits_for_module = false;
        let mut is_in_tests = false;
        (1..).zip(self.text.lines()).filter(move |(_, line)| {
            let code = line.trim_start();
            if code.starts_with("#[cfg(test)]") {
                waits_for_module = true;
            } else if waits_for_module {
                // `mod tests;` is one line, `mod tests {` goes on to the brace in the first column.
                is_in_tests = code.starts_with("mod ") && code.ends_with('{');
                waits_for_module = false;
                return false;
            } else if is_in_tests && *line == "}" {
                is_in_tests = false;
                return false;
            }
            !waits_for_module && !is_in_tests && !code.starts_with("//")
        })
    }
}

/// Names that follow `crate::` in a line: `crate::math::Vec2` gives `math`, `crate::{body, math::Rot}` both.
fn modules_named(line: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, found) in line.match_indices("crate::") {
        // `rustycs_crate::` and the like are other crates.
        if line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let rest = &line[at + found.len()..];
        let list = rest.strip_prefix('{').map_or(rest, |list| list.split('}').next().unwrap_or(list));
        let count = if rest.starts_with('{') { usize::MAX } else { 1 };
        for part in list.split(',').take(count) {
            let name: String =
                part.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            names.push(name);
        }
    }
    names
}

/// The first of some lines, with those that its `crate::{` goes on over.
fn whole_list(lines: &[(usize, &str)]) -> String {
    let mut list = lines[0].1.to_string();
    for (_, next) in &lines[1..] {
        let is_open = list.rsplit_once("crate::{").is_some_and(|(_, names)| !names.contains('}'));
        if !is_open {
            break;
        }
        list.push_str(next);
    }
    list
}

/// What the code of one file, outside of tests, must not name.
fn faults_of_code(source: &Source, own: Option<u32>, fault: &mut impl FnMut(usize, String)) {
    let lines: Vec<(usize, &str)> = source.code().collect();
    for (place, &(number, line)) in lines.iter().enumerate() {
        for name in modules_named(&whole_list(&lines[place..])) {
            let is_above = own.zip(floor_of(&name)).is_some_and(|(own, other)| other > own);
            if is_above {
                fault(number, format!("{} imports from {name}, which is above it", source.module()));
            }
        }
        let words = || line.split(|c: char| !c.is_alphanumeric() && c != '_');
        if source.module() != "compute" && words().any(|word| word == "unsafe") {
            fault(number, "unsafe outside compute".into());
        }
        for name in ["HashMap", "HashSet", "SystemTime", "Instant"] {
            if words().any(|word| word == name) {
                fault(number, format!("{name}: its answers differ from run to run"));
            }
        }
        if line.contains("std::time") {
            fault(number, "std::time: the library reads no clock".into());
        }
    }
}

/// Everything in one file that the house does not allow.
fn faults(source: &Source) -> Vec<String> {
    let mut faults = Vec::new();
    let mut fault = |line: usize, what: String| faults.push(format!("src/{}:{line}: {what}", source.path));
    let lines = source.text.lines().count();
    if lines > LONGEST_FILE {
        fault(lines, format!("{lines} lines, more than {LONGEST_FILE}: split it by idea"));
    }
    if source.path.split(['/', '.']).any(|part| part == "utils" || part == "util") {
        fault(1, "a name that says nothing of what is in it".into());
    }
    for (number, line) in (1..).zip(source.text.lines()) {
        for mark in ["TODO", "FIXME"] {
            if line.contains(mark) {
                fault(number, format!("a {mark}: do it or open an issue"));
            }
        }
    }
    if source.is_test() {
        return faults;
    }
    let own = floor_of(source.module());
    if own.is_none() && source.path != "lib.rs" {
        fault(1, format!("{} stands on no floor: give it one here", source.module()));
    }
    faults_of_code(source, own, &mut fault);
    faults
}

fn read_all(folder: &Path, root: &Path, found: &mut Vec<Source>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            read_all(&path, root, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
            found.push(Source { path: name, text: fs::read_to_string(&path).unwrap() });
        }
    }
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut found = Vec::new();
    read_all(&root, &root, &mut found);
    assert!(found.len() > 50, "only {} files under {}", found.len(), root.display());
    found
}

#[test]
fn the_house_stands_as_designed() {
    let faults: Vec<String> = sources().iter().flat_map(faults).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

/// Parts of modules that import each other in a circle. The list may only become shorter.
const CIRCLES: [&str; 7] = [
    "report::chart",
    "report::order",
    "report::plot",
    "report::result",
    "report::run",
    "report::study",
    "report::text",
];

/// Which parts of modules, files or folders beside their `mod.rs`, import each other in a circle.
fn parts_in_circles(sources: &[Source]) -> Vec<String> {
    let part_of = |source: &Source| {
        let name = source.path.split('/').nth(1)?.trim_end_matches(".rs").to_owned();
        (name != "mod" && !source.is_test()).then(|| format!("{}::{name}", source.module()))
    };
    let parts: BTreeSet<String> = sources.iter().filter_map(part_of).collect();
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for source in sources {
        let Some(part) = part_of(source) else { continue };
        for (_, line) in source.code() {
            let prefix = format!("crate::{}::", source.module());
            for (at, _) in line.match_indices(&prefix) {
                let rest = &line[at + prefix.len()..];
                let list = rest.strip_prefix('{').map_or(rest, |list| list.split('}').next().unwrap_or(list));
                let names = list.split(',').take(if rest.starts_with('{') { usize::MAX } else { 1 });
                for name in names {
                    let name = name.trim().split(|c: char| !c.is_alphanumeric() && c != '_').next();
                    let other = format!("{}::{}", source.module(), name.unwrap_or_default());
                    if other != part && parts.contains(&other) {
                        imports.entry(part.clone()).or_default().insert(other);
                    }
                }
            }
        }
    }
    let comes_back = |part: &&String| {
        let (mut next, mut seen) = (vec![*part], BTreeSet::new());
        while let Some(at) = next.pop() {
            next.extend(imports.get(at).into_iter().flatten().filter(|&other| seen.insert(other)));
        }
        seen.contains(part)
    };
    parts.iter().filter(comes_back).cloned().collect()
}

#[test]
fn no_parts_of_a_module_import_each_other_in_a_circle_but_those_known() {
    assert_eq!(parts_in_circles(&sources()), CIRCLES);
}

#[test]
fn a_circle_is_seen_through_folders_and_over_several_files() {
    let sources = [
        Source::new("body/a/deep.rs", "use crate::body::b::B;"),
        Source::new("body/b.rs", "use crate::body::{Body, c};"),
        Source::new("body/c.rs", "use crate::body::a::{A, D};\nuse crate::body::d::E;"),
        Source::new("body/d.rs", "#[cfg(test)]\nmod tests {\n    use crate::body::c::C;\n}"),
        Source::new("body/mod.rs", "use crate::body::d::E;"),
    ];
    assert_eq!(parts_in_circles(&sources), ["body::a", "body::b", "body::c"]);
}

/// Every module of the crate root has a floor, and every floor that is built is a module.
/// To who gives something else where a vector is wanted the compiler lists all that converts into one: nothing of ours alone.
#[test]
fn nothing_private_converts_into_a_public_type() {
    for source in sources() {
        let is_private = |line: &str| line.starts_with("impl") && line.contains("From<Lane");
        let leak = source.code().find(|(_, line)| is_private(line));
        assert!(leak.is_none(), "{}: {leak:?}; make it a method", source.path);
    }
}

#[test]
fn every_module_of_the_crate_root_has_a_floor() {
    for source in sources() {
        assert!(source.path == "lib.rs" || floor_of(source.module()).is_some(), "{}", source.path);
    }
    for required in ["math", "store", "compute", "shape", "body", "collision", "resolution", "world"] {
        assert!(sources().iter().any(|source| source.module() == required), "src/{required} is gone");
    }
}

/// The checker finds what it is for: one sample of each fault.
#[test]
fn the_checker_fails_on_each_fault() {
    let long = "//! Long.\n".repeat(LONGEST_FILE + 1);
    for (path, text, expected) in [
        ("shape/hull.rs", "use crate::world::World;", "shape imports from world"),
        ("math/rot.rs", "fn f() { crate::body::g() }", "math imports from body"),
        ("body/mod.rs", "use crate::{math::Vec2, collision::Contact};", "body imports from collision"),
        ("body/mod.rs", "use crate::{\n    math::Vec2,\n    world::World,\n};", "body imports from world"),
        ("body/mod.rs", "#[cfg(test)]\nmod tests;\nuse crate::world::World;", "body imports from world"),
        ("body/mod.rs", "#[cfg(test)]\nmod t {\n}\nuse crate::world::World;", "body imports from world"),
        ("world/step.rs", "    unsafe { read(p) }", "unsafe outside compute"),
        ("world/step.rs", "use std::collections::HashMap;", "HashMap"),
        ("world/step.rs", "let now = std::time::Instant::now();", "std::time"),
        ("world/utils.rs", "", "says nothing"),
        ("world/step.rs", "// TODO later", "TODO"),
        ("world/step.rs", &long, "501 lines"),
        ("attic/step.rs", "", "stands on no floor"),
    ] {
        let found = faults(&Source::new(path, text));
        assert!(found.iter().any(|fault| fault.contains(expected)), "{path}: {expected}: {found:?}");
    }
}

/// And it lets pass what is allowed.
#[test]
fn the_checker_passes_what_is_allowed() {
    for (path, text) in [
        ("world/step.rs", "use crate::body::{Body, BodyId};\nuse crate::math::Vec2;"),
        ("body/mod.rs", "//! See [`World`](crate::World).\n/// crate::world::World is above."),
        ("body/mod.rs", "#[cfg(test)]\nmod tests {\n    use crate::world::World;\n}"),
        ("collision/tests/known.rs", "use crate::world::World;"),
        ("compute/lane.rs", "    unsafe { load(p) }"),
        ("lib.rs", "pub use crate::world::World;"),
        ("body/mod.rs", "use othercrate::world::World;"),
    ] {
        let found = faults(&Source::new(path, text));
        assert!(found.is_empty(), "{path}: {found:?}");
    }
}
