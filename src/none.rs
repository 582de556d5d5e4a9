//! The parts that a page lacks: a server of its own, and a fence around another process. Their
//! predicates fail.
use swipl::prelude::*;

natives! {
    /// view_serve_(_, _, _, _, _)
    semidet fn "view_serve_"(_context, _a, _b, _c, _d, _e) { into_prolog_result(false) }
    /// view_visit_(_)
    semidet fn "view_visit_"(_context, _a) { into_prolog_result(false) }
    /// view_leave_(_)
    semidet fn "view_leave_"(_context, _a) { into_prolog_result(false) }
    /// view_end_(_, _)
    semidet fn "view_end_"(_context, _a, _b) { into_prolog_result(false) }
    /// view_shut_(_)
    semidet fn "view_shut_"(_context, _a) { into_prolog_result(false) }
    /// sim_fence_open_(_, _)
    semidet fn "sim_fence_open_"(_context, _a, _b) { into_prolog_result(false) }
    /// sim_fence_join_(_)
    semidet fn "sim_fence_join_"(_context, _a) { into_prolog_result(false) }
    /// sim_fence_serve_(_, _, _)
    semidet fn "sim_fence_serve_"(_context, _a, _b, _c) { into_prolog_result(false) }
    /// sim_fence_silent_
    semidet fn "sim_fence_silent_"(_context) { into_prolog_result(false) }
    /// process_usage_(_, _, _, _, _)
    semidet fn "process_usage_"(_context, _a, _b, _c, _d, _e) { into_prolog_result(false) }
    /// sim_fence_close_
    semidet fn "sim_fence_close_"(_context) { into_prolog_result(false) }
}
