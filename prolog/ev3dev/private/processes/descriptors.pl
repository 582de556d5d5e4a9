:- module(ev3dev_descriptors,
          [ taken/3,                    % +Descriptor, +Mode, -Stream
            dropped/1                   % +Descriptor
          ]).
:- use_module(library(unix), [dup/2]).

/** <module> A process that speaks with another one

A worker of library(ev3dev/sim_batch) and of a far brick uses its standard
streams to speak with the process that has started it. So the program that it
runs must get others.
*/

%!  taken(+Descriptor, +Mode, -Stream) is det.
%
%   Stream, in UTF-8, leads to where this file descriptor did; what is read
%   from the descriptor, or written to it, goes nowhere from now on. Mode is
%   `read` or `write`.

taken(Descriptor, Mode, Stream) :-
    atom_concat('/proc/self/fd/', Descriptor, File),
    (   Mode == write
    ->  How = append                    % a file keeps what it has
    ;   How = Mode
    ),
    open(File, How, Stream, [encoding(utf8)]),
    to_nowhere(Descriptor, Mode).

%!  dropped(+Descriptor) is det.
%
%   What is written to this file descriptor goes nowhere from now on. It may
%   be a socket, which no file leads to.

dropped(Descriptor) :-
    to_nowhere(Descriptor, write).

to_nowhere(Descriptor, Mode) :-
    open('/dev/null', Mode, Null),
    stream_property(Null, file_no(Nothing)),
    dup(Nothing, Descriptor).
