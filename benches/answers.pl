:- module(answers,
          [ answer_terms/1,             % :Answer_2
            cpu_share/2,                % :Goal, -Share
            median/2                    % +Numbers, -Median
          ]).
:- use_module(library(lists)).

/** <module> What the Prolog workers of benches/run.py share
*/

:- meta_predicate
    answer_terms(2),
    cpu_share(0, -).

%!  answer_terms(:Answer_2) is det.
%
%   Read terms to the end of the input. Each is answered by a line of the
%   numbers that call(Answer_2, Term, Numbers) finds.

answer_terms(Answer_2) :-
    repeat,
    read(Term),
    (   Term == end_of_file
    ->  !
    ;   call(Answer_2, Term, Numbers),
        forall(member(Number, Numbers), format("~15g ", [Number])),
        nl,
        flush_output,
        fail
    ).

%!  cpu_share(:Goal, -Share) is semidet.
%
%   Share of a core that this process takes while Goal runs.

cpu_share(Goal, Share) :-
    statistics(process_cputime, Cpu0),
    get_time(Time0),
    call(Goal),
    get_time(Time1),
    statistics(process_cputime, Cpu1),
    Share is (Cpu1 - Cpu0) / (Time1 - Time0).

%!  median(+Numbers, -Median) is det.

median(Numbers, Median) :-
    msort(Numbers, Sorted),
    length(Sorted, Length),
    Half is Length // 2,
    nth0(Half, Sorted, Median).
