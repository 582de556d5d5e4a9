//! A list that only grows, and that is read without a lock.
//!
//! A device has a handful of attributes and constants that are met one after the other and stay for
//! as long as it is plugged in. Finding one of a few is cheaper than taking a lock.
use std::sync::OnceLock;

/// A list that only grows.
#[derive(Debug)]
pub(crate) struct List<T>(OnceLock<Box<(T, List<T>)>>);

impl<T> Default for List<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

impl<T> List<T> {
    /// The first element for which `is` holds.
    pub(crate) fn find(&self, is: impl Fn(&T) -> bool) -> Option<&T> {
        let mut list = self;
        while let Some((element, rest)) = list.0.get().map(|link| &**link) {
            if is(element) {
                return Some(element);
            }
            list = rest;
        }
        None
    }

    /// The first element for which `is` holds; if there is none, the one that `make` makes, at the
    /// end. Of several threads that come for the same element at once, one makes it.
    pub(crate) fn find_or_push(&self, is: impl Fn(&T) -> bool, make: impl Fn() -> T) -> &T {
        let mut list = self;
        loop {
            let (element, rest) = &**list.0.get_or_init(|| Box::new((make(), Self::default())));
            if is(element) {
                return element;
            }
            list = rest;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_element_is_made_once() {
        let list = List::default();
        for word in ["a", "b", "a", "b"] {
            let found = list.find_or_push(|(known, _)| *known == word, || (word, word.len()));
            assert_eq!(found.0, word);
        }
        assert_eq!(list.find(|(known, _)| *known == "b"), Some(&("b", 1)));
        assert_eq!(list.find(|(known, _)| *known == "c"), None);
        let rest = &list.0.get().unwrap().1.0.get().unwrap().1;
        assert!(rest.0.get().is_none(), "two words, two links");
    }
}
