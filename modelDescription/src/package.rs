//! The cargo package that declares the model: whose it is and under which licence. All that an archive says of these is the
//! model's; only the tool that wrote it is ours.

/// What the model's package says of itself. Empty texts: it does not say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Package<'a> {
    /// Its version.
    pub version: &'a str,
    /// Who wrote it.
    pub author: &'a str,
    /// Who holds the copyright, as a sentence.
    pub copyright: &'a str,
    /// Its licence, as an SPDX expression.
    pub license: &'a str,
    /// File names and contents of its licence texts.
    pub texts: &'a [(&'a str, &'a [u8])],
}
