:- module(ev3dev_dev,
          [ ev3_dev/1                   % ?Directory
          ]).
:- use_module(directory, [directory_path/2, environment_directory/2]).
:- use_module(driver, []).
:- use_module(on_demand, [on_demand_loaded/0]).

/** <module> Where keys, speaker and screen are

What is no motor, sensor or light is a device file below `/dev`.
*/

%!  ev3_dev(?Directory) is det.
%
%   Query or set the directory that holds the device files: `fb0`, the screen,
%   and in `input/by-path` the keys and the speaker. At first it is the value
%   of the environment variable EV3DEV_DEV, if that is set and not empty, else
%   `/dev`. A relative one is relative to the working directory. The simulator
%   has its own, which are used from sim_start/1 on.
%
%   A regular file or a named pipe may stand there for a device. For the keys
%   a file holds the events there were; what is written behind them happens
%   then. The screen is told by its length: 3072 bytes, one bit for a pixel,
%   or 91136, four bytes for a pixel.
%
%   @error existence_error(directory, Directory)
%   @see ev3_sysfs/1 for what is below `/sys/class`

ev3_dev(Directory) :-
    var(Directory),
    !,
    dev_(Directory).
ev3_dev(Directory) :-
    directory_path(Directory, Path),
    dev_use_(Path).

use_environment :-
    (   environment_directory('EV3DEV_DEV', Directory)
    ->  ev3_dev(Directory)
    ;   true
    ).

:- initialization(use_environment, now).

:- on_demand_loaded.
