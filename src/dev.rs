//! `prolog/ev3dev/dev.pl`: where the device files are.
use crate::call::{Call, unify_atom};
use crate::state;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_dev();
    register_dev_use();
}

predicates! {
    /// dev_(-Directory)
    #[module("ev3dev_native")]
    #[name("dev_")]
    semidet fn dev(_context, directory) {
        unify_atom(directory, &state::dev().root().to_string_lossy())
    }

    /// dev_use_(+Directory)
    #[module("ev3dev_native")]
    #[name("dev_use_")]
    semidet fn dev_use(context, directory) {
        let directory = Call::of(context, "ev3_dev", 1).text(directory)?;
        state::use_dev_files(&*directory);
        Ok(())
    }
}
