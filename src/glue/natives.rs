//! The one declaration of a native predicate.

/// Defines native predicates, and `register`, which makes them known to Prolog:
///
/// ```ignore
/// natives! {
///     /// slices_(-Count): how many slices of time this thread has waited.
///     semidet fn "slices_"(context, count) { .. }
///
///     /// wait_(+Seconds, -Reason): `over` at the end.
///     nondet fn "wait_"<Slices<Sleep>>(context, seconds, reason) as call("wait", 1) {
///         setup => { .. },
///         call(sleep) => { .. }
///     }
/// }
/// ```
///
/// The bodies are those of `predicates!` of the crate swipl. `call` is the [`Call`] of the public
/// predicate that errors name.
///
/// [`Call`]: crate::glue::call::Call
macro_rules! natives {
    ($(
        $(#[$_comment:meta])*
        $kind:ident fn $name:literal $(<$state:path>)? ($($argument:ident),*)
        $(as $call:ident($public:literal, $arity:literal))? { $($body:tt)* }
    )*) => {
        /// Registers the predicates of this file.
        pub(crate) fn register() {$({
            native! {
                $kind $name ($($state)?) ($($argument),*) ($($call $public $arity)?) { $($body)* }
            }
            register_native();
        })*}
    };
}

/// Defines one of them.
macro_rules! native {
    ($kind:ident $name:literal ($($state:path)?) ($($argument:ident),*) () $body:tt) => {
        predicates! {
            #[module("ev3dev_native")]
            #[name($name)]
            $kind fn native $(<$state>)? ($($argument),*) $body
        }
    };
    (semidet $name:literal () ($context:ident $(, $argument:ident)*)
     ($call:ident $public:literal $arity:literal) $body:tt) => {
        predicates! {
            #[module("ev3dev_native")]
            #[name($name)]
            semidet fn native($context $(, $argument)*) {
                let $call = crate::glue::call::Call::of($context, $public, $arity);
                $body
            }
        }
    };
    (nondet $name:literal ($state:path) ($context:ident $(, $argument:ident)*)
     ($call:ident $public:literal $arity:literal)
     { setup => $setup:tt, call($data:ident) => $next:tt }) => {
        predicates! {
            #[module("ev3dev_native")]
            #[name($name)]
            nondet fn native<$state>($context $(, $argument)*) {
                setup => {
                    let $call = crate::glue::call::Call::of($context, $public, $arity);
                    let _ = &$call; // not every setup needs it
                    $setup
                },
                call($data) => {
                    let $call = crate::glue::call::Call::of($context, $public, $arity);
                    $next
                }
            }
        }
    };
}
