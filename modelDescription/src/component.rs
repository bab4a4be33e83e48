//! What is linked into a library besides the model itself: name, version, licence, where it comes from, and the licence
//! texts that its authors want to go with it. The archive's licences and its bill of materials are written from it.

use serde::{Deserialize, Serialize};

/// One linked component.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Component {
    /// Name in its registry, or in this project.
    pub name: String,
    /// Version.
    pub version: String,
    /// Licence, as an SPDX expression.
    pub license: String,
    /// Package URL, for what is published: `pkg:cargo/libm@0.2.16`.
    pub purl: Option<String>,
    /// SHA-256 of the published archive, in hexadecimal digits.
    pub sha256: Option<String>,
    /// File names and contents of its licence texts; none for what has the product's own licence.
    pub texts: Vec<(String, Vec<u8>)>,
    /// Names with versions ([`id`](Self::id)) of the components that it uses.
    pub uses: Vec<String>,
}

impl Component {
    /// Whether it is somebody else's: published, or with licence texts of its own.
    pub fn is_foreign(&self) -> bool {
        self.purl.is_some() || !self.texts.is_empty()
    }

    /// Name and version, unique among the components of a library and a legal folder name: `libm-0.2.16`.
    pub fn id(&self) -> String {
        format!("{}-{}", self.name, self.version)
    }
}
