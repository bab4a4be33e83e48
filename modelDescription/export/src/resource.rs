//! `fmuResourceLocation` as a path.

use percent_encoding::percent_decode_str;
use std::path::PathBuf;

/// Path of a `file` URI (`file:/a`, `file:///a`, `file://localhost/a`, with percent escapes), or of a plain path, which
/// some importers pass.
///
/// # Errors
/// A sentence when the URI has another scheme, another host, or is not UTF-8 after decoding.
pub fn path(location: &str) -> Result<PathBuf, String> {
    let Some(rest) = location.strip_prefix("file:") else {
        return match location.split_once("://") {
            Some((scheme, _)) => Err(format!(
                "fmuResourceLocation '{location}': expected scheme 'file', got '{scheme}'"
            )),
            None => Ok(PathBuf::from(location)),
        };
    };
    let encoded = match rest.strip_prefix("//") {
        None => rest,
        Some(authority) => {
            let (host, _) = authority.split_once('/').unwrap_or((authority, ""));
            if !(host.is_empty() || host == "localhost") {
                return Err(format!(
                    "fmuResourceLocation '{location}': expected no host or 'localhost', got '{host}'"
                ));
            }
            &authority[host.len()..]
        }
    };
    let decoded = percent_decode_str(encoded).decode_utf8().map_err(|_| {
        format!("fmuResourceLocation '{location}': not UTF-8 after percent decoding")
    })?;
    // file:///C:/x is the drive's path C:/x.
    let drive = decoded
        .strip_prefix('/')
        .filter(|p| p.as_bytes().get(1) == Some(&b':') && cfg!(windows));
    Ok(PathBuf::from(drive.unwrap_or(&decoded)))
}

#[cfg(test)]
mod tests {
    use super::path;
    use std::path::Path;

    #[test]
    fn all_spellings_of_a_file_uri_give_the_path() {
        for (location, expected) in [
            ("file:/a/resources", "/a/resources"),
            ("file:///a/resources", "/a/resources"),
            ("file://localhost/a/resources", "/a/resources"),
            ("file:///a%20b/%C3%BC%7B1%7D", "/a b/ü{1}"),
            ("file:///a b/ü{1}", "/a b/ü{1}"),
            ("/plain/path", "/plain/path"),
        ] {
            assert_eq!(
                path(location).as_deref(),
                Ok(Path::new(expected)),
                "{location}"
            );
        }
    }

    #[test]
    fn another_scheme_another_host_and_bad_escapes_are_named() {
        for (location, part) in [
            ("http://h/a", "'http'"),
            ("file://host/a", "'host'"),
            ("file:///%FF", "not UTF-8"),
        ] {
            let error = path(location).expect_err(location);
            assert!(error.contains(part) && error.contains(location), "{error}");
        }
    }
}
