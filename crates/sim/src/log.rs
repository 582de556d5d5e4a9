//! A list of what happened whose copies share what they have in common.
use std::collections::VecDeque;
use std::sync::Arc;

/// Entries that are shared together. A copy costs a pointer for each chunk, and what is added to
/// it then at most the copy of one.
const CHUNK: usize = 32;

/// The newest entries, up to a number.
#[derive(Debug)]
pub(crate) struct Log<T> {
    /// All are full but the last.
    chunks: VecDeque<Arc<Vec<T>>>,
    most: usize,
}

impl<T> Clone for Log<T> {
    fn clone(&self) -> Log<T> {
        Log { chunks: self.chunks.clone(), most: self.most }
    }
}

impl<T: Clone> Log<T> {
    pub(crate) fn new(most: usize) -> Log<T> {
        Log { chunks: VecDeque::new(), most }
    }

    /// How many entries are kept.
    fn kept(&self) -> usize {
        let last = self.chunks.back().map_or(0, |chunk| chunk.len());
        self.chunks.len().saturating_sub(1) * CHUNK + last
    }

    pub(crate) fn len(&self) -> usize {
        self.kept().min(self.most)
    }

    /// Oldest first.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        let entries = self.chunks.iter().flat_map(|chunk| chunk.iter());
        entries.skip(self.kept() - self.len())
    }

    /// Newest first.
    pub(crate) fn newest(&self) -> impl Iterator<Item = &T> {
        let entries = self.chunks.iter().rev().flat_map(|chunk| chunk.iter().rev());
        entries.take(self.len())
    }

    /// Adds an entry.
    pub(crate) fn push(&mut self, entry: T) {
        if self.chunks.back().is_none_or(|chunk| chunk.len() == CHUNK) {
            if self.kept() >= self.most + CHUNK {
                self.chunks.pop_front();
            }
            self.chunks.push_back(Arc::new(Vec::with_capacity(CHUNK)));
        }
        if let Some(chunk) = self.chunks.back_mut() {
            Arc::make_mut(chunk).push(entry);
        }
    }

    /// Takes the newest entry back.
    pub(crate) fn pop(&mut self) -> Option<T> {
        let chunk = self.chunks.back_mut()?;
        let entry = Arc::make_mut(chunk).pop();
        if chunk.is_empty() {
            self.chunks.pop_back();
        }
        entry
    }

    /// Forgets every second entry, but not the first.
    pub(crate) fn thin_out(&mut self) {
        let mut thinner = Log::new(self.most);
        for entry in self.iter().step_by(2) {
            thinner.push(entry.clone());
        }
        *self = thinner;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(log: &Log<usize>) -> Vec<usize> {
        log.iter().copied().collect()
    }

    #[test]
    fn it_keeps_the_newest() {
        let mut log = Log::new(100);
        for number in 0..1000 {
            log.push(number);
            let first = (number + 1_usize).saturating_sub(100);
            assert_eq!(numbers(&log), (first..=number).collect::<Vec<_>>());
            assert_eq!(log.len(), number + 1 - first);
            assert!(log.chunks.len() <= 5, "memory stays flat: {}", log.chunks.len());
        }
        assert_eq!(log.pop(), Some(999));
        log.thin_out();
        assert_eq!(numbers(&log), (899..999).step_by(2).collect::<Vec<_>>());
        while log.pop().is_some() {}
        assert_eq!(log.len(), 0);
    }

    #[test]
    fn copies_share_all_but_the_newest_entries() {
        let mut log = Log::new(1000);
        for number in 0..500 {
            log.push(number);
        }
        let copy = log.clone();
        log.push(500);
        let shared = log.chunks.iter().zip(&copy.chunks).filter(|(a, b)| Arc::ptr_eq(a, b));
        assert_eq!(shared.count(), copy.chunks.len() - 1);
        assert_eq!(numbers(&copy), (0..500).collect::<Vec<_>>());
        assert_eq!(numbers(&log), (0..=500).collect::<Vec<_>>());
    }
}
