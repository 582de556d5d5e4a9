:- module(ev3dev_core, []).

/** <module> The predicates of library(ev3dev)
*/

:- set_prolog_flag(generate_debug_info, false).
:- use_module(scripts, []).
:- use_module('../help/help', []).
:- use_module('../explain/error_messages', []).
:- use_module('../explain/queries', []).
:- reexport('../../driver').
:- reexport('../../device_table').
:- reexport('../../motors').
:- reexport('../../motor_settings').
:- reexport('../../dc_motors').
:- reexport('../../servo_motors').
:- reexport('../../sensors', except([reading_of/4])).
:- reexport('../../sensor_wait').
:- reexport('../../infrared').
:- reexport('../../nxt_sensors').
:- reexport('../../sensor_info').
:- reexport('../../robot').
:- reexport('../../lights').
:- reexport('../../battery').
:- reexport('../../ports').
:- reexport('../../time').
:- reexport('../../buttons').
:- reexport('../../sound').
:- reexport('../../screen').
