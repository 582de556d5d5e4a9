//! The common parts of attribute files: tables of attributes, parsers of texts.

pub(crate) mod attr;
pub(crate) mod text;
