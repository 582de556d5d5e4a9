//! The one declaration of a native predicate.

/// Defines native predicates, and `register`, which makes them known to Prolog:
///
/// ```ignore
/// natives! {
///     /// slices_(-Count): how many slices of time this thread has waited.
///     semidet fn "slices_"(context, count) { .. }
///
///     /// wait_(+Seconds, -Reason): `over` at the end.
///     nondet fn "wait_"<Slices<Sleep>>(context, seconds, reason) {
///         setup => { .. },
///         call(sleep) => { .. }
///     }
/// }
/// ```
///
/// The bodies are those of `predicates!` of the crate swipl.
macro_rules! natives {
    ($(
        $(#[$_comment:meta])*
        $kind:ident fn $name:literal $(<$state:path>)? ($($argument:ident),*) $body:tt
    )*) => {
        /// Registers the predicates of this file.
        pub(crate) fn register() {$({
            predicates! {
                #[module("ev3dev_native")]
                #[name($name)]
                $kind fn native $(<$state>)? ($($argument),*) $body
            }
            register_native();
        })*}
    };
}
