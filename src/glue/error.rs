//! From the driver's errors to ISO error terms.
//!
//! The formal term says what is wrong in terms of the program. The context names the
//! called predicate and the file, and quotes the kernel's words.
//!
//! | the kernel says | formal term |
//! |---|---|
//! | `ENOENT` | `existence_error(file, Path)` |
//! | `ENODEV`, `ENXIO` | `existence_error(Class, Port)` |
//! | `EACCES`, `EPERM`, `EROFS` | `permission_error(Access, attribute, Path)` |
//! | `EBUSY` | `permission_error(Access, busy_attribute, Path)` |
//! | `EOPNOTSUPP` | `permission_error(Access, unsupported_attribute, Path)` |
//! | `EINVAL`, `ERANGE` to a write | `domain_error(Attribute, Value)` |
//! | `EMFILE`, `ENFILE` | `resource_error(max_files)` |
//! | `ENOMEM` | `resource_error(no_memory)` |
//! | anything else | `system_error(Words)` |
//!
//! Access is `read` or `write`.
use crate::glue::terms::{Ask as _, Prolog, unify_atom, unify_value};
use ev3_driver::device::read_value;
use ev3_driver::error::{Access, Error};
use ev3_driver::{Class, Errno, Registry, Value};
use ev3_os::{Instant, sleep, words};
use ev3_signals::latch::{self, Reason};
use std::error::Error as _;
use std::path::Path;
use std::time::Duration;
use swipl::prelude::*;

/// The origin of errors: the public predicate that was called, by name and arity.
pub(crate) struct Origin<'a, C: Prolog> {
    pub(crate) context: &'a Context<'a, C>,
    pub(crate) name: &'static str,
    pub(crate) arity: u64,
}

/// Raises a driver's error. Its message lists the devices if one of them is missing.
pub(crate) fn raise<T, C: Prolog>(
    call: &Origin<C>,
    error: &Error,
    devices: &Registry,
) -> PrologResult<T> {
    if matches!(error, Error::Interrupted) {
        // The signal handler has raised an exception already.
        return Err(PrologError::Exception);
    }
    if matches!(error, Error::Latched { .. }) {
        end_of_program(call)?;
    }
    let formal = formal(call.context, error, devices)?;
    throw(call, &formal, &message(error, devices))
}

/// Where no motor may start because the program ends, so does this call: by the signal that
/// Prolog is about to get, or as Prolog ends this thread, or, in a clean-up, by an abort.
fn end_of_program<C: Prolog>(call: &Origin<C>) -> PrologResult<()> {
    /// Prolog ends its threads sooner than that.
    const MOST: Duration = Duration::from_millis(100);
    let since = Instant::now();
    while latch::is_ending() {
        call.context.handle_signals()?;
        if latch::is_set_as(Reason::Halting) && since.elapsed() > MOST {
            return call.context.ask(pred!("system:abort/0"), []);
        }
        sleep(Duration::from_millis(10));
    }
    Ok(())
}

/// `throw(Formal, Called, Message)`, for `private/run/waits.pl` to throw.
///
/// A nondeterministic predicate must not throw when it is called again: before SWI-Prolog 7.3,
/// Prolog then calls it once more, to forget a state that is gone already.
pub(crate) fn to_be_thrown<'a, C: Prolog>(
    call: &Origin<'a, C>,
    error: &Error,
    devices: &Registry,
) -> PrologResult<Term<'a>> {
    let context = call.context;
    let formal = formal(context, error, devices)?;
    let [formal, indicator, text] = ball(call, formal, &message(error, devices))?;
    term! {context: throw(#&formal, #&indicator, #&text)}
}

/// Raises `instantiation_error` for a variable, else `type_error`.
pub(crate) fn wrong_type<T, C: Prolog>(
    call: &Origin<C>,
    expected: &str,
    term: &Term,
) -> PrologResult<T> {
    wrong_type_because(call, expected, term, "")
}

/// The same, with the reason as the message.
pub(crate) fn wrong_type_because<T, C: Prolog>(
    call: &Origin<C>,
    expected: &str,
    term: &Term,
    reason: &str,
) -> PrologResult<T> {
    let context = call.context;
    let formal = if term.is_var() {
        term! {context: instantiation_error}?
    } else {
        term! {context: type_error(#atomable(expected), #term)}?
    };
    throw(call, &formal, reason)
}

/// Raises `domain_error(Domain, Term)`.
pub(crate) fn wrong_value<T, C: Prolog>(
    call: &Origin<C>,
    domain: &str,
    term: &Term,
) -> PrologResult<T> {
    wrong_because(call, domain, term, "")
}

/// Raises `domain_error(Domain, Term)`, with the reason as the message.
pub(crate) fn wrong_because<T, C: Prolog>(
    call: &Origin<C>,
    domain: &str,
    term: &Term,
    reason: &str,
) -> PrologResult<T> {
    let context = call.context;
    let formal = term! {context: domain_error(#atomable(domain), #term)}?;
    throw(call, &formal, reason)
}

/// Raises `existence_error(Kind, Name)`, with the reason as the message.
#[cfg(feature = "sim")]
pub(crate) fn no_such<T, C: Prolog>(
    call: &Origin<C>,
    kind: &str,
    name: &str,
    reason: &str,
) -> PrologResult<T> {
    let context = call.context;
    let formal = term! {context: existence_error(#atomable(kind), #atomable(name))}?;
    throw(call, &formal, reason)
}

/// Raises the error for an integer of more than 64 bits.
pub(crate) fn too_long<T, C: Prolog>(call: &Origin<C>) -> PrologResult<T> {
    let context = call.context;
    let formal = term! {context: representation_error(int64_t)}?;
    throw(call, &formal, "")
}

/// Raises the error for a text that Rust, and a file's name, cannot have: half of a surrogate pair.
pub(crate) fn no_text<T, C: Prolog>(call: &Origin<C>) -> PrologResult<T> {
    let context = call.context;
    let formal = term! {context: representation_error(character)}?;
    throw(call, &formal, "")
}

/// Raises `error(Formal, context(Called, Message))`, as `prolog/ev3dev/private/errors/errors.pl`
/// does: that file finds the predicate that the program called, and words an empty message.
fn throw<'a, T, C: Prolog>(
    call: &Origin<'a, C>,
    formal: &Term<'a>,
    message: &str,
) -> PrologResult<T> {
    let formal = formal.clone();
    let ball = ball(call, formal, message)?;
    call.context.ask(pred!("ev3dev_errors:throw_error/3"), ball.each_ref())?;
    // It has thrown.
    Err(PrologError::Exception)
}

/// The arguments of `throw_error/3`.
fn ball<'a, C: Prolog>(
    call: &Origin<'a, C>,
    formal: Term<'a>,
    message: &str,
) -> PrologResult<[Term<'a>; 3]> {
    let (indicator, text) = (call.context.new_term_ref(), call.context.new_term_ref());
    indicator.unify(Functor::new("/", 2))?;
    indicator.unify_arg(1, atomable(call.name))?;
    indicator.unify_arg(2, call.arity)?;
    unify_atom(&text, message)?;
    Ok([formal, indicator, text])
}

/// The formal term of a driver's error.
fn formal<'a, C: Prolog>(
    context: &'a Context<'a, C>,
    error: &Error,
    devices: &Registry,
) -> PrologResult<Term<'a>> {
    let attribute = error.path().map(file_name).unwrap_or_default();
    let path = error.path().map(Path::to_string_lossy).unwrap_or_default();
    let (attribute, path) = (atomable(&*attribute), atomable(&*path));
    let access = match error {
        Error::Write { .. } | Error::Open { access: Access::Write, .. } => "write",
        _ => "read",
    };
    match error {
        Error::Unplugged { class, port } => {
            let (class, port) = (atomable(class.to_string()), atomable(port.as_str()));
            term! {context: existence_error(#class, #port)}
        }
        Error::Latched { path } => {
            let port = atomable(device_of(path, devices).1);
            term! {context: permission_error(start, motor, #port)}
        }
        Error::Malformed { .. } => term! {context: syntax_error(attribute)},
        Error::Format { format, .. } => term! {context: syntax_error(#atomable(*format))},
        Error::NoProgram { program, .. } => {
            term! {context: existence_error(program, #atomable(*program))}
        }
        Error::NoValue { index, .. } => {
            term! {context: domain_error(sensor_value_index, #i64::try_from(*index).unwrap_or(i64::MAX))}
        }
        Error::NotOnBus { port, .. } => {
            term! {context: domain_error(i2c_sensor, #atomable(port.as_str()))}
        }
        Error::DuplicatePort { port } => {
            term! {context: domain_error(distinct_ports, #atomable(port.as_str()))}
        }
        Error::UnknownMotorType { name } => {
            term! {context: domain_error(motor_type, #atomable(name.as_str()))}
        }
        Error::Pattern { pattern, .. } => {
            term! {context: domain_error(file_name_pattern, #atomable(pattern.as_str()))}
        }
        Error::Write { text, .. } if matches!(error.errno(), Some(Errno::INVAL | Errno::RANGE)) => {
            let value = context.new_term_ref();
            unify_value(&value, &Value::parse(text.clone()))?;
            term! {context: domain_error(#attribute, #&value)}
        }
        error if error.path().is_some_and(has_nul) => {
            term! {context: domain_error(file_name, #path)}
        }
        error => match error.errno() {
            Some(Errno::NOENT) => term! {context: existence_error(file, #path)},
            Some(Errno::ACCESS | Errno::PERM | Errno::ROFS) => {
                term! {context: permission_error(#atomable(access), attribute, #path)}
            }
            Some(Errno::BUSY) => {
                term! {context: permission_error(#atomable(access), busy_attribute, #path)}
            }
            Some(Errno::OPNOTSUPP) => {
                term! {context: permission_error(#atomable(access), unsupported_attribute, #path)}
            }
            Some(Errno::NODEV | Errno::NXIO) => {
                let device = error.path().map(|path| device_of(path, devices)).unwrap_or_default();
                let (class, port) = (atomable(device.0), atomable(device.1));
                term! {context: existence_error(#class, #port)}
            }
            Some(Errno::MFILE | Errno::NFILE) => term! {context: resource_error(max_files)},
            Some(Errno::NOMEM) => term! {context: resource_error(no_memory)},
            _ => term! {context: system_error(#atomable(message(error, devices)))},
        },
    }
}

/// The operation, the path and the kernel's words; then what there is, if a device is
/// missing, and what the kernel takes, if it refused a word.
fn message(error: &Error, devices: &Registry) -> String {
    let source = error.source().map(|source| format!(": {}", words(source)));
    // The list of devices does not help if a picture is missing.
    let is_device = |path: &Path| path.starts_with(devices.tree().root());
    let is_gone = error.is_unplugged() && error.path().is_none_or(is_device);
    let rest = if is_gone { connected(devices) } else { allowed(error, devices) };
    format!("{error}{}{rest}", source.unwrap_or_default())
}

/// The values that an attribute takes, if its driver lists them in a file beside it.
fn allowed(error: &Error, devices: &Registry) -> String {
    let Some(path) = error.path().filter(|_| error.errno() == Some(Errno::INVAL)) else {
        return String::new();
    };
    let list = match &*file_name(path) {
        "command" => "commands",
        "mode" => "modes",
        "stop_action" => "stop_actions",
        _ => return String::new(),
    };
    match read_value(devices.tree(), &path.with_file_name(list)) {
        Ok(Value::Text(all)) => format!("; there are: {}", all.replace(' ', ", ")),
        _ => String::new(),
    }
}

/// The connected motors and sensors. Servos are left out because there are many.
fn connected(devices: &Registry) -> String {
    let all = [Class::TachoMotor, Class::DcMotor, Class::Sensor].map(|class| devices.all(class));
    let names: Vec<String> = all
        .iter()
        .flatten()
        .flat_map(|devices| devices.iter())
        .map(|device| format!("{} ({})", device.port(), device.driver()))
        .collect();
    if names.is_empty() {
        "; nothing is connected".to_owned()
    } else {
        format!("; connected: {}", names.join(", "))
    }
}

/// The class and port of the device that an attribute file belongs to, or the
/// file itself where that is unknown.
fn device_of(path: &Path, devices: &Registry) -> (String, String) {
    let owner = Class::ALL.into_iter().find_map(|class| {
        let listed = devices.all(class).ok()?;
        let device = listed.iter().find(|device| path.starts_with(device.path()))?;
        Some((class.to_string(), device.port().to_owned()))
    });
    owner.unwrap_or_else(|| ("file".to_owned(), path.to_string_lossy().into_owned()))
}

/// No file has such a name.
fn has_nul(path: &Path) -> bool {
    path.as_os_str().as_encoded_bytes().contains(&0)
}

fn file_name(path: &Path) -> std::borrow::Cow<'_, str> {
    path.file_name().map(std::ffi::OsStr::to_string_lossy).unwrap_or_default()
}
