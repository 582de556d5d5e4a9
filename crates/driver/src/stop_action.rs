//! The action of a motor when it is stopped.

/// The action of a motor at the end of a move, or when it is stopped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StopAction {
    /// Rolls out freely.
    Coast,
    /// Rolls out with its winding shorted.
    #[default]
    Brake,
    /// Keeps its position, actively.
    Hold,
}

impl StopAction {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Coast, Self::Brake, Self::Hold];

    /// The kernel's word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Coast => "coast",
            Self::Brake => "brake",
            Self::Hold => "hold",
        }
    }

    /// The action of that name.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|action| action.word() == word)
    }
}
