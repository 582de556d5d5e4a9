//! Waits that can be left.
//!
//! A wait looks whether it is over, lets some time pass, and looks again. After each slice of time
//! its caller may do something else: handle signals, serve events, or drop the wait. What has to
//! be undone when a wait is left, as the motors of a move to be stopped, its `Drop` undoes.
use crate::error::{Error, Interrupted, Result};
use std::time::Duration;

/// What a look has found.
#[derive(Debug)]
pub enum Look<T> {
    /// The wait is over.
    Over(T),
    /// Look again at this moment, or earlier.
    Again(Duration),
}

impl<T> Look<T> {
    /// Look again after this time, or earlier if the wait may last until `deadline` only. `over` is
    /// its end if the time is up.
    pub(crate) fn again(
        now: Duration,
        slice: Duration,
        deadline: Option<Duration>,
        over: T,
    ) -> Self {
        let left = deadline.map_or(Duration::MAX, |deadline| deadline.saturating_sub(now));
        if left.is_zero() { Self::Over(over) } else { Self::Again(now + left.min(slice)) }
    }
}

/// Something to wait for.
pub trait Wait {
    /// The result at the end.
    type End;

    /// Whether it is over. Errors: those of what is waited for.
    fn look(&mut self) -> Result<Look<Self::End>>;

    /// Lets time pass until `end`, or for less. `false` as for
    /// [`Sysfs::pause`](crate::sysfs::Sysfs::pause).
    fn pause(&mut self, end: Duration) -> Result<bool>;
}

impl<W: Wait + ?Sized> Wait for Box<W> {
    type End = W::End;

    fn look(&mut self) -> Result<Look<W::End>> {
        (**self).look()
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        (**self).pause(end)
    }
}

/// Any wait with that end.
pub type AnyWait<'a, T> = Slices<Box<dyn Wait<End = T> + Send + 'a>>;

/// A wait, slice by slice.
#[derive(Debug)]
pub struct Slices<W> {
    wait: W,
    /// The end of a pause that has not passed yet.
    pausing: Option<Duration>,
}

impl<W: Wait> Slices<W> {
    /// Nothing happens yet.
    pub fn new(wait: W) -> Self {
        Self { wait, pausing: None }
    }

    /// The same, whatever is waited for.
    pub fn boxed<'a>(self) -> AnyWait<'a, W::End>
    where
        W: Send + 'a,
    {
        Slices { wait: Box::new(self.wait), pausing: self.pausing }
    }

    /// Looks, and lets time pass, until `latest` at most. The end of the wait, or `None`: then the
    /// caller handles signals, and calls again. Errors: as [`Wait::look`] and [`Wait::pause`].
    pub fn slice(&mut self, latest: Option<Duration>) -> Result<Option<W::End>> {
        let end = match self.pausing {
            Some(end) => end,
            None => match self.wait.look()? {
                Look::Over(end) => return Ok(Some(end)),
                Look::Again(end) => latest.map_or(end, |latest| end.min(latest)),
            },
        };
        self.pausing = (!self.wait.pause(end)?).then_some(end);
        Ok(None)
    }

    /// Looks when it is time to, and lets no time pass. `now` is the time of the tree.
    pub fn poll(&mut self, now: Duration) -> Result<Look<W::End>> {
        if let Some(end) = self.pausing.take() {
            if now < end || !self.wait.pause(now)? {
                self.pausing = Some(end);
                return Ok(Look::Again(end));
            }
        }
        let look = self.wait.look()?;
        if let Look::Again(end) = look {
            self.pausing = Some(end);
        }
        Ok(look)
    }

    /// Waits to the end. Errors: as [`slice`](Self::slice); [`Error::Interrupted`].
    pub fn block(mut self, interrupted: Interrupted) -> Result<W::End> {
        while !interrupted() {
            if let Some(end) = self.slice(None)? {
                return Ok(end);
            }
        }
        Err(Error::Interrupted)
    }
}
