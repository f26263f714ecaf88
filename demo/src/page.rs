//! The page around the demo: in the browser its address stands for the command line, as in
//! `#scene=galaxy&seed=3&overlays=names,trails&compare`.

/// Options of the command line that an address may have.
const OPTIONS: [&str; 6] = ["scene", "seed", "overlays", "page", "crowd", "compare"];

/// The command line that an address stands for, its `#` left out. What it does not know it passes over.
#[cfg_attr(not(target_family = "wasm"), allow(dead_code, reason = "a window has a command line"))]
pub(crate) fn command_line(address: &str) -> Vec<String> {
    let mut words = vec!["rustycs-demo".to_owned()];
    for part in address.split('&') {
        let (name, value) = part.split_once('=').unwrap_or((part, ""));
        if OPTIONS.contains(&name) {
            words.push(format!("--{name}"));
            words.extend(Some(value.to_owned()).filter(|value| !value.is_empty()));
        }
    }
    words
}

/// What stands after `#` in the address of the page, its escapes resolved.
#[cfg(target_family = "wasm")]
pub(crate) fn address() -> String {
    (0..imported::address_length())
        .filter_map(|index| char::from_u32(imported::address_character(index)))
        .collect()
}

/// What `web/index.html` gives.
#[cfg(target_family = "wasm")]
#[allow(unsafe_code, reason = "numbers go in and out; the page can do nothing with them but answer")]
mod imported {
    // SAFETY: both take and return numbers and touch no memory of the program.
    #[link(wasm_import_module = "env")]
    unsafe extern "C" {
        /// How many characters the address has.
        pub(super) safe fn address_length() -> u32;
        /// One of them, as its code point.
        pub(super) safe fn address_character(index: u32) -> u32;
    }
}

#[cfg(test)]
mod tests {
    use super::command_line;
    use crate::cli::Cli;
    use crate::overlay::Overlay;
    use clap::Parser;

    #[test]
    fn an_address_is_a_command_line() {
        let address = "scene=galaxy&seed=3&overlays=trails,names&compare&headless&utm_source=x";
        let start = Cli::try_parse_from(command_line(address)).unwrap().start();
        assert_eq!((start.scene.name, start.seed, start.compares), ("galaxy", 3, true));
        assert_eq!(start.overlays, Some(vec![Overlay::Trails, Overlay::Names]));
        assert_eq!(command_line(""), ["rustycs-demo"]);
        assert!(Cli::try_parse_from(command_line("scene=nowhere")).is_err());
    }
}
