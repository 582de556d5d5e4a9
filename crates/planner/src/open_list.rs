//! What a search will look at next.
use std::collections::{BTreeMap, VecDeque};

/// Entries in the order of their keys, the oldest of a key first.
#[derive(Debug)]
pub(crate) struct OpenList<K, E> {
    lists: BTreeMap<K, VecDeque<E>>,
    len: usize,
}

impl<K: Ord + Copy, E> OpenList<K, E> {
    pub(crate) fn new() -> Self {
        OpenList { lists: BTreeMap::new(), len: 0 }
    }

    pub(crate) fn push(&mut self, key: K, entry: E) {
        self.len += 1;
        self.lists.entry(key).or_default().push_back(entry);
    }

    pub(crate) fn pop(&mut self) -> Option<E> {
        let mut first = self.lists.first_entry()?;
        let entry = first.get_mut().pop_front();
        if first.get().is_empty() {
            first.remove();
        }
        self.len -= 1;
        entry
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// About the bytes that it takes.
    pub(crate) fn bytes(&self) -> usize {
        2 * self.len * size_of::<E>()
    }
}
