:- module(ev3dev_view_worlds,
          [ world_line/3                % +Word, +Rest, -Answer
          ]).
:- use_module('../chance', [end_chance/0]).
:- use_module('../native', [view_source_/1]).
:- use_module('../world_name',
              [name_world/1, noted_world/2, world_name/1]).
:- use_module(program, [end_program/1]).

/** <module> The world as a page begins it

To begin a world is to start the simulation again, in place of the running
one, after the program was stopped as by STOP.
*/

%   How long, in seconds, the program may take to end.
patience(3).

%!  world_line(+Word, +Rest, -Answer) is semidet.
%
%   Do what a line of the page says. Answer is done(More) or refused(Why).
%   Fails if that is no line.

world_line(Word, Rest, Answer) :-
    request(Word, Rest, Request),
    (   catch(answer(Request, Answer0), error(Formal, Context), true)
    ->  (   var(Formal)
        ->  Answer = Answer0
        ;   Answer = refused(error(Formal, Context))
        )
    ;   why_not(Why),
        Answer = refused(Why)
    ).

request(reset, "", reset).

answer(reset, done([])) :-
    simulated,
    noted_world(World, Options),
    (   world_name(Name)
    ->  true
    ;   Name = none
    ),
    begin(World, Options, Name).

simulated :-
    view_source_(sim).

why_not("No simulation runs.") :-
    \+ simulated,
    !.
why_not("The program does not end. Try again when it has.").

%   What is impossible is found before anything ends.
begin(World, Options, Name) :-
    patience(Seconds),
    end_program(Seconds),
    ev3dev_sim:sim_start(World, Options),
    % The numbers of the seed are for the program, not for this thread.
    end_chance,
    catch(thread_signal(main, ev3dev_chance:begin_chance_of(Options)), _,
          true),
    (   Name == none
    ->  true
    ;   name_world(Name)
    ).
