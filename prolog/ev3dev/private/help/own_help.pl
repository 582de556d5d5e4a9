:- module(ev3dev_own_help,
          [ help/1,                     % +What
            apropos/1                   % +Query
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(help_index, [asked/1]).

/** <module> help/1 and apropos/1 where Prolog comes without them

They answer for the pack alone.
*/

:- multifile prolog:message//1.

%!  help(+What) is det.
%
%   Print the comments of the pack's predicates What, Name or Name/Arity.

help(What) :-
    (   asked(help(What))
    ->  true
    ;   print_message(warning, ev3dev(no_help(What)))
    ).

%!  apropos(+Query) is det.
%
%   Print the pack's predicates that Query, a text, is about.

apropos(Query) :-
    (   asked(apropos(Query))
    ->  true
    ;   print_message(warning, ev3dev(no_match(Query)))
    ).

prolog:message(ev3dev(no_help(What))) -->
    [ 'No help for ~p'-[What] ].
prolog:message(ev3dev(no_match(Query))) -->
    [ 'No matches for ~p'-[Query] ].
