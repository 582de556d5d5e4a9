//! The common parts of attribute files: tables of attributes, error numbers, parsers of texts.

pub(crate) mod attr;
pub(crate) mod errno;
pub(crate) mod text;
