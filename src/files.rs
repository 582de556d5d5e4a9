//! `prolog/ev3dev/sysfs.pl`, `dev.pl`: any file, and the directories of the two trees.
use crate::driver::{Bound, unify_device};
use crate::glue::state::{self, devices, use_files};
use crate::glue::terms::{unify_atom, unify_value};
use ev3_driver::class::Detected;
use ev3_driver::device::{read_value, write_file};
use std::io::ErrorKind;
use std::path::Path;
use std::vec::IntoIter;
use swipl::prelude::*;

natives! {
    /// subsystem_detect_(?Port, ?Type, ?Path, +Pattern)
    nondet fn "subsystem_detect_"<IntoIter<Detected>>(context, port, kind, path, pattern) as call("subsystem_detect", 4) {
        setup => {
            let pattern = call.text(pattern)?;
            let bound = Bound::of(&call, port, kind, path)?;
            let mut detected = call.or_throw(call.devices()?.detect(&pattern))?;
            detected.retain(|device| bound.admits(device));
            Ok(Some(detected.into_iter()))
        },
        call(detected) => {
            call
                .next(detected, |_| Ok(()), |device, ()| unify_device(device, port, kind, path))
        }
    }

    /// file_read_(+File, -Value)
    semidet fn "file_read_"(context, file, value) as call("file_read", 2) {
        let path = call.text(file)?;
        let read = call.or_throw(read_value(call.devices()?.tree(), Path::new(&*path)))?;
        unify_value(value, &read)
    }

    /// file_write_(+File, +Value)
    semidet fn "file_write_"(context, file, value) as call("file_write", 2) {
        let (path, text) = (call.text(file)?, call.value(value)?);
        call.or_throw(write_file(call.devices()?.tree(), Path::new(&*path), &text))
    }

    /// stale_mount_(+Directory): the program that serves the files below it has ended.
    semidet fn "stale_mount_"(context, directory) as call("ev3_sysfs", 1) {
        let directory = call.text(directory)?;
        let looked = std::fs::metadata(&*directory);
        into_prolog_result(looked.is_err_and(|error| error.kind() == ErrorKind::NotConnected))
    }

    /// sysfs_(-Root)
    semidet fn "sysfs_"(_context, root) {
        unify_atom(root, &devices().tree().root().to_string_lossy())
    }

    /// sysfs_use_(+Root): a directory that exists.
    semidet fn "sysfs_use_"(context, root) as call("ev3_sysfs", 1) {
        let root = call.text(root)?;
        let used = use_files(&*root);
        crate::sim::end_unless_mounted();
        call.or_throw(used)
    }

    /// dev_(-Directory)
    semidet fn "dev_"(_context, directory) {
        unify_atom(directory, &state::dev().root().to_string_lossy())
    }

    /// dev_use_(+Directory)
    semidet fn "dev_use_"(context, directory) as call("ev3_dev", 1) {
        let directory = call.text(directory)?;
        state::use_dev_files(&*directory);
        Ok(())
    }
}
