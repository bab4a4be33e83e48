//! What a field's attributes say.

use proc_macro2::TokenStream;
use syn::ext::IdentExt as _;
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Error, Expr, ExprLit, Field, Ident, Lit, LitInt, Meta, Result, Token};

/// Who computes the variable, by the attribute's name and the method of `Variable`.
const CAUSALITIES: [&str; 5] = ["input", "output", "parameter", "calculated", "local"];

/// What a field is.
pub enum Role {
    /// A row.
    Row(Box<Row>),
    /// A struct, or an array of structs, whose rows are taken over.
    Part(Box<Part>),
    /// Neither.
    State,
}

/// The attribute of a row.
pub struct Row {
    pub causality: Ident,
    /// None where the row's place counts.
    pub number: Option<LitInt>,
    pub keys: Vec<(Ident, Option<Expr>)>,
    pub about: String,
}

/// The attribute `part`.
#[derive(Default)]
pub struct Part {
    pub each: bool,
    pub from: Option<Expr>,
    pub prefix: Option<Expr>,
    pub about: Option<Expr>,
}

impl Row {
    /// The value of a key.
    pub fn key(&self, name: &str) -> Option<&Expr> {
        self.keys
            .iter()
            .find(|(key, _)| key == name)
            .and_then(|(_, value)| value.as_ref())
    }

    /// Whether a key stands there.
    pub fn has(&self, name: &str) -> bool {
        self.span(name).is_some()
    }

    /// The key itself, where it stands.
    pub fn span(&self, name: &str) -> Option<&Ident> {
        let mut keys = self.keys.iter().map(|(key, _)| key);
        keys.find(|key| *key == name)
    }
}

/// Number and keys: `97, unit = SECOND, tunable`; the number may be missing.
#[derive(Default)]
struct Keys {
    number: Option<LitInt>,
    keys: Vec<(Ident, Option<Expr>)>,
}

const KNOWN: [&str; 16] = [
    "unit",
    "range",
    "integers",
    "items",
    "boolean",
    "max_size",
    "mime_type",
    "name",
    "start",
    "tunable",
    "discrete",
    "continuous",
    "from",
    "nan",
    "typed",
    "about",
];

impl Parse for Keys {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let number = if input.peek(LitInt) {
            Some(input.parse()?)
        } else {
            None
        };
        let mut keys = Vec::new();
        while !input.is_empty() {
            if number.is_some() || !keys.is_empty() {
                input.parse::<Token![,]>()?;
                if input.is_empty() {
                    break;
                }
            }
            let key = input.call(Ident::parse_any)?;
            if !KNOWN.iter().any(|known| key == known) {
                let message = format!("unknown key {key}, expected one of {}", KNOWN.join(", "));
                return Err(Error::new(key.span(), message));
            }
            let value = if input.peek(Token![=]) {
                input.parse::<Token![=]>()?;
                Some(input.parse()?)
            } else {
                None
            };
            keys.push((key, value));
        }
        Ok(Self { number, keys })
    }
}

impl Role {
    /// What `field` is.
    pub fn of(field: &Field) -> Result<Self> {
        let mut role = Self::State;
        for attribute in &field.attrs {
            let Some(name) = attribute.path().get_ident() else {
                continue;
            };
            let found = if CAUSALITIES.iter().any(|causality| name == causality) {
                let Keys { number, keys } = match attribute.meta {
                    Meta::Path(_) => Keys::default(),
                    _ => attribute.parse_args()?,
                };
                Self::Row(Box::new(Row {
                    causality: name.clone(),
                    number,
                    keys,
                    about: about(&field.attrs),
                }))
            } else if name == "part" {
                Self::Part(Box::new(part(attribute)?))
            } else {
                continue;
            };
            if !matches!(role, Self::State) {
                return Err(Error::new(name.span(), "a field is one row or one part"));
            }
            role = found;
        }
        Ok(role)
    }
}

fn part(attribute: &Attribute) -> Result<Part> {
    let mut part = Part::default();
    if matches!(attribute.meta, Meta::Path(_)) {
        return Ok(part);
    }
    attribute.parse_nested_meta(|meta| {
        if meta.path.is_ident("each") {
            part.each = true;
        } else if meta.path.is_ident("from") {
            part.from = Some(meta.value()?.parse()?);
        } else if meta.path.is_ident("prefix") {
            part.prefix = Some(meta.value()?.parse()?);
        } else if meta.path.is_ident("about") {
            part.about = Some(meta.value()?.parse()?);
        } else {
            return Err(meta.error("expected each, from, prefix or about"));
        }
        Ok(())
    })?;
    Ok(part)
}

/// The documentation as one sentence: lines joined, without the full stop at the end.
pub fn about(attributes: &[Attribute]) -> String {
    let lines = attributes
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }) => Some(text.value().trim().to_owned()),
                _ => None,
            },
            _ => None,
        });
    let text = lines.collect::<Vec<_>>().join(" ");
    text.strip_suffix('.').map(str::to_owned).unwrap_or(text)
}

/// Whether the struct says `#[rows(discrete)]`.
pub fn is_discrete(attributes: &[Attribute]) -> Result<bool> {
    let mut discrete = false;
    for attribute in attributes.iter().filter(|a| a.path().is_ident("rows")) {
        attribute.parse_nested_meta(|meta| {
            if meta.path.is_ident("discrete") {
                discrete = true;
                Ok(())
            } else {
                Err(meta.error("expected discrete"))
            }
        })?;
    }
    Ok(discrete)
}

/// An expression that is one name: a constant of `module` in the package `fmu-declaration`, whose path is `root`.
pub fn constant(expression: &Expr, module: &str, root: &TokenStream) -> TokenStream {
    let module = Ident::new(module, proc_macro2::Span::call_site());
    match expression {
        Expr::Path(path) if path.path.get_ident().is_some() => {
            quote::quote!(#root::#module::#path)
        }
        _ => quote::quote!(#expression),
    }
}
