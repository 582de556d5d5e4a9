//! What attribute files have in common: tables of attributes, error numbers, parsers of texts.

pub(crate) mod attr;
pub(crate) mod errno;
pub(crate) mod text;
