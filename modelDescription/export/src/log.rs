//! Messages to the importer, by category.

use crate::ffi::{Status, fmi2, fmi3};
use std::ffi::{CStr, CString};
use std::fmt;

/// Log categories, as declared in the XML. A message goes out only under one of them, and only if it is enabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// `logStatusError`: a refused call or a failed step.
    Error,
    /// `logStatusWarning`: accepted, but probably not meant.
    Warning,
    /// `logEvents`: what happens in the life of the instance and of the model.
    Event,
}

/// The name that stands for all categories.
pub const ALL: &CStr = c"logAll";

impl Category {
    /// All categories.
    pub const LIST: [Self; 3] = [Self::Error, Self::Warning, Self::Event];

    /// Name and description, as in the XML.
    pub const fn name(self) -> (&'static CStr, &'static str) {
        match self {
            Self::Error => (c"logStatusError", "refused calls and failed steps"),
            Self::Warning => (c"logStatusWarning", "accepted, but probably not meant"),
            Self::Event => (
                c"logEvents",
                "life cycle of the instance, events of the model",
            ),
        }
    }

    fn status(self) -> Status {
        match self {
            Self::Error => Status::Error,
            Self::Warning => Status::Warning,
            Self::Event => Status::Ok,
        }
    }
}

/// Which categories are enabled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Enabled([bool; 3]);

impl Enabled {
    /// All or none.
    pub const fn all(on: bool) -> Self {
        Self([on; 3])
    }

    /// Switches one category.
    pub fn set(&mut self, category: Category, on: bool) {
        self.0[category as usize] = on;
    }

    /// Whether the category is enabled.
    pub const fn has(self, category: Category) -> bool {
        self.0[category as usize]
    }
}

/// What the importer gave an instance to log with.
#[derive(Clone, Copy)]
pub(crate) enum Sink {
    /// By fmi2Instantiate.
    Fmi2(fmi2::Callbacks),
    /// By fmi3InstantiateCoSimulation or fmi3InstantiateScheduledExecution.
    Fmi3(fmi3::Logger),
}

/// Where messages of one instance go.
pub struct Log<'a> {
    sink: Option<(&'a Sink, &'a CStr)>,
    enabled: Enabled,
}

impl<'a> Log<'a> {
    /// A log to the importer's logger, under the instance's name.
    pub(crate) fn new(sink: &'a Sink, instance_name: &'a CStr, enabled: Enabled) -> Self {
        Self {
            sink: Some((sink, instance_name)),
            enabled,
        }
    }

    /// A log that goes nowhere, for tests and for models used without an importer.
    pub const fn silent() -> Self {
        Self {
            sink: None,
            enabled: Enabled::all(false),
        }
    }

    /// Something happened in the model (well under one message a step).
    pub fn event(&mut self, message: fmt::Arguments<'_>) {
        self.write(Category::Event, message);
    }

    /// Accepted, but probably not meant.
    pub fn warning(&mut self, message: fmt::Arguments<'_>) {
        self.write(Category::Warning, message);
    }

    /// A refused call or a failed step.
    pub(crate) fn error(&mut self, message: fmt::Arguments<'_>) {
        self.write(Category::Error, message);
    }

    fn write(&mut self, category: Category, message: fmt::Arguments<'_>) {
        let Some((sink, instance_name)) = self.sink else {
            return;
        };
        // FMI 3.0.3, section 2.2.4: errors are logged regardless of the settings.
        let always = category == Category::Error && matches!(sink, Sink::Fmi3(_));
        if !always && !self.enabled.has(category) {
            return;
        }
        let (status, name, text) = (category.status(), category.name().0, finished(message));
        match sink {
            Sink::Fmi2(callbacks) => callbacks.log(instance_name, status, name, &text),
            Sink::Fmi3(logger) => logger.log(status, name, &text),
        }
    }
}

/// Finished text in one line: the importer hands it to printf, where `%` starts a directive, and some importers expand
/// `#`. Line breaks come from panic messages (`assert_eq!` writes three lines) and from what an importer passed.
fn finished(message: fmt::Arguments<'_>) -> CString {
    let text = message
        .to_string()
        .replace('%', " percent")
        .replace('#', "no. ")
        .replace('\0', "")
        .replace(char::is_control, " ");
    CString::new(text.trim_end()).unwrap_or_default()
}
