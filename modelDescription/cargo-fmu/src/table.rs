//! The table `[package.metadata.fmu]` of a `Cargo.toml`, key by key, so that a wrong one is named.

use crate::facts::Version;
use crate::process::{Failure, Outcome};
use cargo_metadata::Package;
use serde_json::{Map, Value};

/// What may stand there.
const KEYS: [&str; 9] = [
    "author",
    "copyright",
    "licenses",
    "icon",
    "guide",
    "picture",
    "resources",
    "extra",
    "fmi",
];

/// How the table's name is misspelt. Tables of other names are other programs'.
const MISSPELT: [&str; 3] = ["fmus", "cargo-fmu", "cargo_fmu"];

/// Most of a wrong value that a message shows, in letters.
const SHOWN: usize = 60;

/// All of it, read.
#[derive(Debug, Default)]
pub(crate) struct Table {
    pub author: Option<String>,
    pub copyright: Option<String>,
    pub licenses: Option<Vec<String>>,
    pub icon: Option<String>,
    pub guide: Option<String>,
    pub picture: Option<String>,
    pub resources: Option<String>,
    pub extra: Option<String>,
    pub fmi: Option<Vec<Version>>,
}

impl Table {
    /// Reads it.
    ///
    /// # Errors
    /// Names the key, its value and what was expected.
    pub fn of(package: &Package) -> Outcome<Self> {
        misspelt(package)?;
        let table = match &package.metadata["fmu"] {
            Value::Null => return Ok(Self::default()),
            Value::Object(table) => table,
            other => {
                let expected = format!("a table with some of the keys {}", KEYS.join(", "));
                return Err(wrong(package, "", &shown(other), &expected));
            }
        };
        if let Some(key) = table.keys().find(|key| !KEYS.contains(&key.as_str())) {
            let expected = format!("one of the keys {}", KEYS.join(", "));
            return Err(wrong(package, key, "", &expected));
        }
        let keys = Keys { package, table };
        let versions = "[\"2.0\"], [\"3.0\"] or both";
        let fmi = keys.list("fmi", versions, Version::named)?;
        if fmi.as_ref().is_some_and(Vec::is_empty) {
            return Err(wrong(package, "fmi", "[]", versions));
        }
        Ok(Self {
            author: keys.text("author")?,
            copyright: keys.text("copyright")?,
            licenses: keys.list("licenses", "a list of paths", |path| Some(path.to_owned()))?,
            icon: keys.text("icon")?,
            guide: keys.text("guide")?,
            picture: keys.text("picture")?,
            resources: keys.text("resources")?,
            extra: keys.text("extra")?,
            fmi,
        })
    }
}

struct Keys<'a> {
    package: &'a Package,
    table: &'a Map<String, Value>,
}

impl Keys<'_> {
    fn text(&self, key: &str) -> Outcome<Option<String>> {
        match self.table.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text.clone())),
            Some(other) => Err(wrong(self.package, key, &shown(other), "a text")),
        }
    }

    fn list<T>(
        &self,
        key: &str,
        expected: &str,
        read: impl Fn(&str) -> Option<T>,
    ) -> Outcome<Option<Vec<T>>> {
        let Some(value) = self.table.get(key) else {
            return Ok(None);
        };
        let items = value.as_array().and_then(|items| {
            let items = items.iter();
            items
                .map(|item| item.as_str().and_then(&read))
                .collect::<Option<Vec<_>>>()
        });
        items.map_or_else(
            || Err(wrong(self.package, key, &shown(value), expected)),
            |items| Ok(Some(items)),
        )
    }
}

/// Refuses a table whose name is nearly ours: nothing in it would arrive.
fn misspelt(package: &Package) -> Outcome {
    let names = package.metadata.as_object().into_iter().flatten();
    for (name, _) in names {
        let capitals = name != "fmu" && name.eq_ignore_ascii_case("fmu");
        if capitals || MISSPELT.contains(&name.as_str()) {
            let manifest = &package.manifest_path;
            return Err(Failure::Found(format!(
                "{manifest}: [package.metadata.{name}]: expected [package.metadata.fmu]"
            )));
        }
    }
    Ok(())
}

/// What is wrong with a value; empty texts for a key and a value that there are not.
pub(crate) fn wrong(package: &Package, key: &str, value: &str, expected: &str) -> Failure {
    let manifest = &package.manifest_path;
    let place = match (key, value) {
        ("", value) => format!(" = {value}"),
        (key, "") => format!(": {key}"),
        (key, value) => format!(": {key} = {value}"),
    };
    Failure::Found(format!(
        "{manifest}: [package.metadata.fmu]{place}: expected {expected}"
    ))
}

/// A value on one line.
fn shown(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= SHOWN {
        return text;
    }
    text.chars().take(SHOWN).chain(['…']).collect()
}
