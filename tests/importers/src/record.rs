//! A table of numbers in a file: a line of names, then a line of numbers for each instant.
//!
//! ```text
//! t,q,engage
//! 0.0,0.05,1.0
//! 0.002,0.051,1.0
//! ```
//!
//! Numbers are written with the fewest digits that read back to the same bits, as Python's `repr` does.

use std::fmt::Write as _;

/// Names and rows, the time first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Name of each column but the time.
    pub names: Vec<String>,
    /// Time (s), and the columns' values.
    pub rows: Vec<(f64, Vec<f64>)>,
}

impl Record {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// The line that has another form.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines();
        let names: Vec<_> = lines
            .next()
            .and_then(|head| head.strip_prefix("t,"))
            .ok_or("expected the first line to begin with `t,`")?
            .split(',')
            .map(str::to_owned)
            .collect();
        let rows = lines.zip(2..).map(|(line, number)| {
            let wrong = || {
                format!(
                    "line {number}: expected {} numbers: {line}",
                    names.len() + 1
                )
            };
            let values: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
            let values = values.map_err(|_| wrong())?;
            match values.split_first() {
                Some((&t, values)) if values.len() == names.len() => Ok((t, values.to_vec())),
                _ => Err(wrong()),
            }
        });
        let rows: Result<_, String> = rows.collect();
        Ok(Self { rows: rows?, names })
    }

    /// The text of a file.
    pub fn text(&self) -> String {
        let mut text = format!("t,{}\n", self.names.join(","));
        for (t, values) in &self.rows {
            write!(text, "{t:?}").expect("a string takes all");
            for value in values {
                write!(text, ",{value:?}").expect("a string takes all");
            }
            text.push('\n');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::Record;

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let record = Record {
            names: ["q", "energy.G"].map(Into::into).into(),
            rows: vec![
                (0.1 + 0.2, vec![1.0 / 3.0, -0.0]),
                (f64::MIN_POSITIVE, vec![1e300, 5e-324]),
            ],
        };
        let again = Record::parse(&record.text()).expect("our own text");
        assert_eq!(again, record);
        assert!(again.rows[0].1[1].is_sign_negative());
    }

    #[test]
    fn a_line_of_another_length_is_named() {
        for (text, part) in [
            ("q\n", "`t,`"),
            ("t,q\n0.0,1.0\n0.1\n", "line 3"),
            ("t,q\n0.0,x\n", "line 2"),
        ] {
            let error = Record::parse(text).expect_err(text);
            assert!(error.contains(part), "{error}");
        }
    }
}
