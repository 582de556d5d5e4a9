:- module(ev3dev_prompt,
          [ reads_query/0,
            acting_at_prompt/1          % :Goal
          ]).

/** <module> The prompt of the toplevel

What happens while Prolog waits for a query happens within the call that reads
the query.
*/

:- meta_predicate acting_at_prompt(0).

%!  reads_query is semidet.
%
%   True if the toplevel of this thread waits for a query, does not expand
%   one, and no goal of acting_at_prompt/1 is under way.

%   There are few frames above the toplevel then; in a deep recursion there is
%   no need to look at all.
reads_query :-
    prolog_current_frame(Frame),
    reads_query(Frame, 100).

reads_query(Frame, Left) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    (   reader(Indicator)
    ->  true
    ;   Left > 0,
        \+ actor(Indicator),
        prolog_frame_attribute(Frame, parent, Parent),
        Left1 is Left - 1,
        reads_query(Parent, Left1)
    ).

%   Prolog may have given up some of these frames for their last calls.
reader('$toplevel':read_query_line/2).
reader('$toplevel':read_query/3).
reader('$toplevel':read_expanded_query/3).
reader('$toplevel':read_term_as_atom/2).

%   The query has been read, and begins. A predicate of this module has no
%   module there.
actor('$toplevel':call_expand_query/4).
actor(acting_at_prompt/1).
actor(ev3dev_prompt:acting_at_prompt/1).

%!  acting_at_prompt(:Goal) is semidet.
%
%   Call Goal once. It is a program, and not the toplevel, that runs now.

acting_at_prompt(Goal) :-
    call(Goal),
    !.
