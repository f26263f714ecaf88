//! A table that is written while its rows come, and read again by the next run.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// A row of a table.
pub(crate) trait Record: Sized {
    /// The names of the fields, in their order.
    const COLUMNS: &[&str];

    /// Whether it is a measurement of the same thing.
    fn replaces(&self, other: &Self) -> bool;

    fn fields(&self) -> Vec<String>;

    /// From its fields, which `next` gives in their order.
    fn read(next: impl FnMut() -> Option<String>) -> Option<Self>;
}

fn line<R: Record>(row: &R) -> String {
    let fields: Vec<String> = row.fields().iter().map(|field| quoted(field)).collect();
    fields.join(",") + "\n"
}

fn read<R: Record>(line: &str) -> Option<R> {
    let mut fields = fields(line).into_iter();
    R::read(|| fields.next())
}

/// A field as RFC 4180 has it: in quotes where it needs them.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

/// The fields of a line.
pub(crate) fn fields(line: &str) -> Vec<String> {
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
        // A line that was cut short by a sudden end is no row.
        for row in text.lines().skip(1).filter_map(read).filter(keeps) {
            rows.retain(|other| !row.replaces(other));
            rows.push(row);
        }
        let mut text = R::COLUMNS.join(",") + "\n";
        text.extend(rows.iter().map(line));
        let new = path.with_extension("csv.new");
        fs::write(&new, text)?;
        fs::rename(&new, path)?;
        Ok(Self { rows, path: path.into(), file: OpenOptions::new().append(true).open(path)? })
    }

    pub(crate) fn rows(&self) -> &[R] {
        &self.rows
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row, in the file too.
    pub(crate) fn add(&mut self, row: R) -> io::Result<()> {
        self.file.write_all(line(&row).as_bytes())?;
        self.file.flush()?;
        self.rows.retain(|other| !row.replaces(other));
        self.rows.push(row);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::rows::Row;
    use crate::error::rows::tests::row;

    #[test]
    fn rows_are_read_as_they_were_written() {
        let lost = Row { error: f64::INFINITY, unit: "m".into(), ..row() };
        for row in [row(), lost] {
            assert_eq!(read(line(&row).trim_end()), Some(row));
        }
        let cut = line(&row());
        assert_eq!(read::<Row>(&cut[..cut.len() - 25]), None);
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
