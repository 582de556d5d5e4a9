:- module(ev3dev_explain,
          [ explain/2,                  % +Format, +Arguments
            is_explained/0
          ]).

/** <module> What debug(ev3dev) tells

library(debug) is not loaded for it: that takes a brick as long as the pack
itself. A program that asks for messages has loaded it.
*/

%!  explain(+Format, +Arguments) is det.
%
%   Print a message, as format/2, if the topic `ev3dev` is being debugged.

explain(Format, Arguments) :-
    (   is_explained
    ->  prolog_debug:debug(ev3dev, Format, Arguments)
    ;   true
    ).

%!  is_explained is semidet.
%
%   True if the topic `ev3dev` is being debugged.

is_explained :-
    current_module(prolog_debug),
    prolog_debug:debugging(ev3dev).

%   debug/1 says that nobody uses a topic that no loaded file names for
%   library(debug).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

user:message_hook(debug_no_topic(ev3dev), warning, _).
