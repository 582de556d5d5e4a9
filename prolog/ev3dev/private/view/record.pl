:- module(ev3dev_view_record,
          [ keep_record/0,
            record_line/4               % +Word, +Rest, +Page, -Answer
          ]).
:- use_module('../native/native', [view_keep_/2, view_say_/2]).
:- use_module(log, [error_text/2]).

/** <module> What Prolog thought, for a page

Frames say how much library(ev3dev/reasoning) has recorded; a page asks for it
when it shows it.
*/

%!  keep_record is det.

keep_record :-
    (   catch(ev3dev_reasoning_page:record_size(Record, Events), _, fail),
        Events > 0
    ->  view_keep_(record, [Record, Events])
    ;   view_keep_(record, null)
    ).

%!  record_line(+Word, +Rest, +Page, -Answer) is semidet.
%
%   A page wants to have the record. It comes later, since it takes up to
%   seconds: STOP is heard meanwhile. Fails if that is not a line.

record_line(record, "", Page, later) :-
    Goal = ev3dev_view_record:record_say(Page),
    (   current_prolog_flag(threads, true)
    ->  thread_create(Goal, _, [detached(true)])
    ;   call(Goal)
    ).

record_say(Page) :-
    catch(forall(ev3dev_reasoning_page:record_part(Pairs),
                 view_say_(Page, json([type=done, what=record|Pairs]))),
          Error, true),
    (   var(Error)
    ->  true
    ;   error_text(Error, Why),
        view_say_(Page, json([type=refused, what=record, why=Why]))
    ).
