//! What a report writes is well formed.

use rustycs::prelude::*;
use rustycs::report::{Axis, Chart, Mark, Measure, Point, Report, Series, Study, Unit};

use crate::report::{sliding, thrown};

/// Reports of all kinds: many rows, one row, rows without an error, names that need care.
fn reports() -> Vec<Report> {
    let study = || Study::new(sliding).name("a \"box\", | <sliding> & stopping\n");
    let rates = [15.0, 30.0, 60.0, 120.0, 240.0];
    let classic = rates.map(|tick_rate| Settings { tick_rate, ..Settings::classic() });
    let rows = || study().tick_rates(rates).substeps([1, 2, 4, 8, 16]);
    [
        rows().also("classic, as it was", classic),
        rows().iterations([1, 2, 4]).measure(Measure::Penetration),
        study(),
        Study::new(thrown).tick_rates(rates),
        Study::new(thrown).measure(Measure::Penetration),
        rows().measure(Measure::quantity("a, b", "m²", World::energy)),
        rows().measure(Measure::error("not a number", "", |_| f64::NAN)),
    ]
    .map(|study| study.run().unwrap())
    .into()
}

/// Fields of a line of CSV.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    for c in line.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    assert!(!is_quoted, "{line}");
    fields
}

#[test]
fn csv_has_a_row_per_settings_and_a_number_where_one_belongs() {
    for report in reports() {
        // A line that ends within quotes goes on.
        let text = report.to_csv().replace("stopping\n", "stopping ");
        let lines: Vec<Vec<String>> = text.lines().map(fields).collect();
        assert_eq!(lines.len(), report.rows().len() + 1);
        assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{text}");
        let column = |name: &str| lines[0].iter().position(|field| field == name).unwrap();
        for (line, row) in lines[1..].iter().zip(report.rows()) {
            assert_eq!(line[column("settings")], row.label);
            let error: f64 = line[column("error")].parse().unwrap();
            assert!(error == row.error || error.is_infinite());
            assert_eq!(line[column("tick_rate_hz")].parse(), Ok(row.settings.tick_rate));
            assert_eq!(line[column("run_time_least")], "");
        }
    }
}

#[test]
fn markdown_tables_have_the_same_columns_in_every_line() {
    for report in reports() {
        let text = report.to_markdown().replace("\\|", "");
        let mut last = None;
        for line in text.lines() {
            let columns = line.starts_with('|').then(|| line.matches('|').count());
            assert!(last.is_none() || columns.is_none() || last == columns, "{text}");
            last = columns;
        }
        assert!(text.lines().filter(|line| line.contains(" Hz × ")).count() >= report.rows().len());
    }
}

/// Reads attribute `name` of an element.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    element.split(&format!(" {name}=\"")).nth(1)?.split('"').next()
}

/// Left, top, right, bottom of a word in the picture, px: 5.6 px for a letter, which is rather little.
fn word_box(element: &str) -> Option<[f64; 4]> {
    let number = |name| attribute(element, name)?.parse::<f64>().ok();
    let (x, y) = (number("x")?, number("y")?);
    let words = element.split_once('>')?.1.split('<').next()?;
    let size = if element.contains("class=\"title\"") { 7.5 } else { 5.6 };
    let wide = size * words.chars().count() as f64;
    let left = match attribute(element, "text-anchor")? {
        "start" => x,
        "middle" => x - 0.5 * wide,
        _ => x - wide,
    };
    Some([left, y - 9.0, left + wide, y + 3.0])
}

/// Fails unless every tag is closed, every number is one, and no two words overlap.
fn assert_legible(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("every tag ends");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    assert!(!svg.contains("NaN") && !svg.contains("=\"inf") && !svg.contains("& "), "{svg}");
    let boxes: Vec<(&str, [f64; 4])> = svg
        .lines()
        .filter(|line| line.starts_with("<text"))
        .filter_map(|line| Some((line, word_box(line)?)))
        .collect();
    for (index, (one, a)) in boxes.iter().enumerate() {
        assert!(a[0] >= 0.0 && a[2] <= 960.0 && a[1] >= 0.0 && a[3] <= 600.0, "outside: {one}");
        for (other, b) in &boxes[..index] {
            let overlap = a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
            assert!(!overlap, "{one}\n{other}");
        }
    }
}

#[test]
fn svg_is_well_formed_and_its_words_do_not_overlap() {
    for report in reports() {
        assert_legible(&report.to_svg());
    }
}

/// A chart of three methods whose errors fall with orders 1, 2 and not at all, with points of every kind.
fn chart_of_methods() -> Chart {
    let series = |order: i32| {
        let point = |step: i32| {
            let cost = 1e-5 * f64::from(1 << step);
            let error = 0.1 * f64::from(1 << step).powi(-order);
            let mark = [Mark::Plain, Mark::Apart, Mark::Aside, Mark::AsGoodAsReference][step as usize % 4];
            Point { cost, error, label: format!("{step} of {order}"), mark }
        };
        let lost = Point { cost: 1.0, error: f64::INFINITY, label: "lost".into(), mark: Mark::Plain };
        let exact = Point { error: 0.0, ..lost.clone() };
        Series { name: format!("order {order}"), points: (0..9).map(point).chain([lost, exact]).collect() }
    };
    Chart {
        title: "methods <1> & <2>".into(),
        facts: vec!["One.".into(), "Two.".into()],
        cost: Axis { name: "time".into(), unit: Unit::Of("s".into()) },
        error: Axis { name: "error".into(), unit: Unit::Part },
        series: [1, 2, 0].map(series).into(),
        front: Vec::new(),
        has_slopes: true,
    }
}

#[test]
fn a_chart_of_ones_own_is_drawn_with_a_sign_for_every_kind_of_point() {
    let chart = chart_of_methods();
    let svg = chart.to_svg();
    assert_legible(&svg);
    let count = |what: &str| svg.matches(what).count();
    // Of nine points in each series three are plain, two apart, two aside and two as good as the reference; the
    // legend has a sign for each series and for the two kinds that need a word.
    assert_eq!(count("class=\"faint"), 3 * 2 + 1);
    assert_eq!(count("hollow\""), 3 * 2 + 1);
    assert_eq!(count("class=\"mark"), 3 * (3 + 2 + 2) + 3 + 1);
    assert_eq!(count("class=\"line"), 3 + 3, "a line for each series, and one in the legend");
    assert_eq!(count("class=\"guide"), 2 + 1, "two slopes, and one in the legend");
    assert!(svg.contains("6 with error 0 or ∞"));
    let flat = Chart { has_slopes: false, ..chart.clone() };
    assert!(!flat.to_svg().contains("class=\"guide") && !flat.to_svg().contains("slopes"));
    let nothing = Chart { series: Vec::new(), ..chart };
    assert_legible(&nothing.to_svg());
}
