//! A table that is written while its rows come, and read again by the next run.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A row of a table, on one line of its file or on several that follow each other.
pub(crate) trait Record: Sized {
    /// The names of the fields, in their order.
    const COLUMNS: &[&str];

    /// Whether it is a measurement of the same thing.
    fn replaces(&self, other: &Self) -> bool;

    /// The fields of each of its lines.
    fn lines(&self) -> Vec<Vec<String>>;

    /// From its first line, and as many of the next as are its own; `None` if they are no row, or not a whole one.
    fn read(first: Fields, next: &mut dyn Iterator<Item = Fields>) -> Option<Self>;
}

/// The fields of a line, to be taken in their order.
#[derive(Debug)]
pub(crate) struct Fields(std::vec::IntoIter<String>);

impl Fields {
    fn new(line: &str) -> Self {
        Self(fields(line).into_iter())
    }

    /// The next field, as it is written.
    pub(crate) fn text(&mut self) -> Option<String> {
        self.0.next()
    }

    /// The next field, if it is a number.
    pub(crate) fn number<T: FromStr>(&mut self) -> Option<T> {
        self.text()?.parse().ok()
    }
}

/// A row as it stands in the file.
fn text_of<R: Record>(row: &R) -> String {
    let quoted = |fields: &Vec<String>| fields.iter().map(|field| quoted(field)).collect::<Vec<_>>();
    row.lines().iter().map(|fields| quoted(fields).join(",") + "\n").collect()
}

/// The rows of a file, without its heading. What was cut short by a sudden end is no row.
fn read_all<R: Record>(text: &str) -> Vec<R> {
    let mut rows = Vec::new();
    let mut lines = text.lines().skip(1).map(Fields::new);
    while let Some(first) = lines.next() {
        rows.extend(R::read(first, &mut lines));
    }
    rows
}

/// A field as RFC 4180 has it: in quotes where it needs them.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

/// The fields of a line.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        let last = fields.len() - 1;
        match character {
            '"' if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                fields[last].push('"');
            }
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            character => fields[last].push(character),
        }
    }
    fields
}

/// Rows and their file.
#[derive(Debug)]
pub(crate) struct Table<R> {
    rows: Vec<R>,
    path: PathBuf,
    file: File,
}

impl<R: Record> Table<R> {
    /// Reads the rows of a file for which `keeps` holds, if there is one, and writes them back without the others.
    pub(crate) fn open(path: &Path, keeps: impl Fn(&R) -> bool) -> io::Result<Self> {
        let text = if path.exists() { fs::read_to_string(path)? } else { String::new() };
        let mut rows: Vec<R> = Vec::new();
        for row in read_all(&text).into_iter().filter(keeps) {
            replace(&mut rows, row);
        }
        write_all(path, &rows)?;
        Ok(Self { rows, path: path.into(), file: OpenOptions::new().append(true).open(path)? })
    }

    /// Writes the rows without those that were replaced, and gives them back.
    pub(crate) fn close(self) -> io::Result<Vec<R>> {
        write_all(&self.path, &self.rows)?;
        Ok(self.rows)
    }

    pub(crate) fn rows(&self) -> &[R] {
        &self.rows
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row, in the file too.
    pub(crate) fn add(&mut self, row: R) -> io::Result<()> {
        self.file.write_all(text_of(&row).as_bytes())?;
        self.file.flush()?;
        // In the file the row it replaces stays until the end; the later one of two is read.
        replace(&mut self.rows, row);
        Ok(())
    }
}

/// Writes a file anew, whole or not at all.
fn write_all<R: Record>(path: &Path, rows: &[R]) -> io::Result<()> {
    let mut text = R::COLUMNS.join(",") + "\n";
    text.extend(rows.iter().map(text_of));
    let new = path.with_extension("csv.new");
    fs::write(&new, text)?;
    fs::rename(&new, path)
}

/// Adds a row in the place of the one it replaces, if there is one.
fn replace<R: Record>(rows: &mut Vec<R>, row: R) {
    rows.retain(|other| !row.replaces(other));
    rows.push(row);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::rows::Row;
    use crate::error::rows::tests::row;

    #[test]
    fn rows_are_read_as_they_were_written() {
        let lost = Row { error: f64::INFINITY, unit: "m".into(), ..row() };
        let text = format!("heading\n{}{}", text_of(&row()), text_of(&lost));
        assert_eq!(read_all::<Row>(&text), [row(), lost]);
        assert_eq!(read_all::<Row>(&text[..text.len() - 25]), [row()]);
    }

    #[test]
    fn a_table_resumes_with_the_rows_that_still_hold() {
        let folder = std::env::temp_dir().join(format!("rustycs-peers-table-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("error.csv");
        let other = Row { engine: "Rapier".into(), ..row() };
        {
            let mut table = Table::<Row>::open(&path, |_| true).unwrap();
            table.add(row()).unwrap();
            table.add(other.clone()).unwrap();
            table.add(Row { error: 0.5, ..row() }).unwrap();
            assert_eq!(table.rows().len(), 2, "a row replaces the one before");
            let rows = table.close().unwrap();
            assert_eq!(
                read_all::<Row>(&fs::read_to_string(&path).unwrap()),
                rows,
                "in the file too, at the end"
            );
        }
        // The end of a process within a line.
        let text = fs::read_to_string(&path).unwrap() + "slide,00,rust";
        fs::write(&path, text).unwrap();
        let table = Table::<Row>::open(&path, |_| true).unwrap();
        assert_eq!(table.rows(), [other.clone(), Row { error: 0.5, ..row() }]);
        drop(table);
        let mut table = Table::open(&path, |row: &Row| row.engine == "Rapier").unwrap();
        assert_eq!(table.rows(), [other]);
        table.add(row()).unwrap();
        assert_eq!(Table::<Row>::open(&path, |_| true).unwrap().rows().len(), 2);
        fs::remove_dir_all(&folder).unwrap();
    }
}
