% A worker of library(ev3dev/sim_batch): a Prolog that has loaded the program,
% and makes a copy of itself for each run.

:- module(ev3dev_batch_worker, [work/0]).
:- prolog_load_context(directory, Room),
   file_directory_name(Room, Private),
   file_directory_name(Private, Ev3dev),
   file_directory_name(Ev3dev, Library),
   asserta(user:file_search_path(library, Library)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/private/simulation/random_seed),
              [begin_chance/1]).
:- use_module(library(ev3dev/private/errors/message_text), [message_text/2]).
:- use_module(library(ev3dev/private/processes/descriptors),
              [dropped/1, taken/3]).
:- use_module(library(unix), [fork/1, wait/2]).

%!  work is det.
%
%   Reads loud(Begin) or quiet(Begin), Begin being begin(File, Test, World,
%   Options), answers `ready` or refused(Error), and from then on reads
%   seeds. The copy for a seed answers process(Pid) and score(Score); when it
%   has ended comes over(Status), as of wait/2.

work :-
    % fork/1 wants one thread. 7.2.3 has no such predicate, and none there.
    StopThread =.. [set_prolog_gc_thread, false],
    ignore(catch(StopThread, _, true)),
    taken(0, read, In),
    taken(1, write, Out),
    set_prolog_flag(ev3dev_hints, off),
    read(In, How),
    (   How = quiet(Begin)
    ->  dropped(2)
    ;   How = loud(Begin)
    ),
    catch(( begin(Begin, Test, Start),
            Answer = ready ), Error,
          Answer = refused(Error)),
    (   How = loud(_)
    ->  dropped(2)
    ;   true
    ),
    reply(Out, Answer),
    Answer == ready,
    repeat,
    read(In, Seed),
    (   Seed == end_of_file
    ->  !
    ;   run(Out, Seed, Test, Start),
        fail
    ).

reply(Out, Term) :-
    format(Out, '~k~n', [Term]),
    flush_output(Out).

%!  begin(+Begin, -Test, -Start) is det.
%
%   Loads the program. Start is start(World, Options). It is tried.

begin(begin(File, Test0, World, Options), Module:Test0,
      start(World, Options)) :-
    load_files(user:File, []),
    (   module_property(Module, file(File))
    ->  true
    ;   Module = user
    ),
    functor(Test0, Name, Arity0),
    (   World == none
    ->  Arity is Arity0+2
    ;   Arity is Arity0+1
    ),
    (   current_predicate(Module:Name/Arity)
    ->  true
    ;   throw(error(existence_error(procedure, Name/Arity), _))
    ),
    (   World == none
    ->  true
    ;   with_sim(World, true, Options)
    ).

run(Out, Seed, Test, Start) :-
    catch(fork(Copy), Error, true),
    (   nonvar(Error)           % the program has threads
    ->  score_of(Error, Score),
        reply(Out, score(Score)),
        reply(Out, over(none))
    ;   Copy == child
    ->  current_prolog_flag(pid, Process),
        reply(Out, process(Process)),
        score(Seed, Test, Start, Score),
        reply(Out, score(Score)),
        halt
    ;   wait(Copy, Status),
        reply(Out, over(Status))
    ).

score(Seed, Test, start(World, Options), Score) :-
    catch(( in_world(World, Seed, Test, Found, Options)
          ->  Score = Found
          ;   Score = failed
          ), Error, score_of(Error, Score)).

in_world(none, Seed, Test, Found, _) :-
    !,
    begin_chance(Seed),
    call(Test, Seed, Found).
in_world(World, Seed, Test, Found, Options) :-
    with_sim(World, call(Test, Found), [seed(Seed)|Options]).

score_of(Error, error(Message)) :-
    message_text(Error, Message).
