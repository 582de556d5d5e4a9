:- module(ev3dev_command_line,
          [ command_line/4,             % +Arguments, -Command, -Files, -O
            setting/3,                  % +Name, +Options, -Value
            setting/4,                  % +Name, +Options, -Value, +Default
            is_help/2,                  % +Arguments, -Command
            help/1,                     % +Command
            no_such/2,                  % +Kind, +Name
            complain/3                  % +Arguments, +Format, +Values
          ]).
:- use_module(library(lists), [append/3, member/2]).

/** <module> The command line of app/ev3dev.pl

A command line that makes no sense throws usage(Format, Values), a sentence.

library(optparse) would save nothing: in 7.2.3 it takes no 60 for a float and
prints by itself, and it knows no commands.
*/

%   command(?Command, ?Arguments, ?Text): [FILE] may be missing, and there may
%   be several of PROGRAM...
command(view, '[FILE]', 'show the robot in a browser, and the toplevel').
command(sim, 'WORLD', 'view, with a simulated robot in WORLD').
command(run, 'FILE', 'load a program, call start/0 or main/0 or --goal').
command(playground, '[FOLDER]',
        'serve the page with Prolog and the robot in it').
command(try, 'EXERCISE PROGRAM',
        'show the points of a program, with reasons').
command(mark, 'EXERCISE PROGRAM...',
        'mark programs, or all programs in folders').
command(devices, '', 'list the connected devices').
command(check, '', 'try each motor and sensor; lift the robot first').
command(work, '', 'make runs for sim_batch/5 elsewhere, through Redis').
command(jog, '', 'drive with the arrow keys of the terminal').

%   option(?Option, ?Value, ?Type, ?Commands, ?Text): Type is in words.
option(world, 'WORLD', 'a world', [run, devices, check, jog],
       'simulate the robot, in a world').
option(robot, 'ROBOT', 'a robot', [sim, run, devices, check, jog],
       'another simulated robot').
option(noise, '', flag, [sim, run, jog], 'errors like those of real devices').
option(seed, 'N', 'a whole number', [sim, run, jog], 'other random numbers').
option(clock, 'CLOCK', 'virtual, realtime, or a factor', [sim, run, jog],
       'of simulated time: virtual, realtime, or a factor').
option(for, 'S', 'a number', [run],
       'end after S seconds of the robot\'s time').
option(goal, 'GOAL', 'a goal', [run], 'call it').
option(reasoning, '', flag, [run], 'print what Prolog tried and what failed').
option(view, '', flag, [run, jog], 'show the robot in a browser').
option(port, 'P', 'a whole number below 65536',
       [view, sim, run, jog, playground], 'of the page\'s address').
option(address, any, any, [view, sim, run, jog, playground],
       'other machines can open the page, too').
option('no-open', '', flag, [view, sim, run, jog, playground],
       'open no browser').
option(jobs, 'N', 'a whole number above 0', [try, mark],
       'runs at a time: one for each processor').
option(seeds, 'A-B', 'seeds, as 1-10', [try, mark],
       'other runs than those of the exercise').
option(page, 'PAGE', 'a file', [try], 'for the picture').
option(out, 'FOLDER', 'a folder', [mark], 'for the reports: marks').
option(format, 'FORMAT', 'a format', [mark],
       'only html, csv, or another one of docs/marking.md').
option(participants, 'LIST', 'a file', [mark],
       'the class: a grading worksheet, roster or other table').
option(earlier, 'FOLDER', 'a folder', [mark],
       'an earlier class, for similar programs').
option(resume, '', flag, [mark],
       'only the runs that are not in FOLDER yet').
option('no-fence', '', flag, [mark],
       'programs can read files and use the network').
option(redis, 'ADDRESS', 'an address', [work, mark],
       'of the server, as HOST:PORT: localhost:6379').
option(workers, 'N', 'a whole number above 0', [work],
       'runs at a time: one for each processor').
option(speed, 'P', 'a number above 0, at most 100', [jog],
       'percent of full speed: 30').
option(wheel, 'D', 'a number above 0', [jog],
       'diameter of the wheels in cm: 5.6').
option(axle, 'L', 'a number above 0', [jog],
       'length of the axle in cm: 10.6').
option(left, 'PORT', 'a port', [jog], 'port of the left motor: outB').
option(right, 'PORT', 'a port', [jog], 'port of the right motor: outC').

%   needs(?Option, ?Other): says nothing without Other, if the command has it.
needs(robot, world).
needs(noise, world).
needs(seed, world).
needs(clock, world).
needs(port, view).
needs(address, view).
needs('no-open', view).

%   number(?Type, ?Number, ?Condition)
number('a number', N, N >= 0).
number('a number above 0', N, N > 0).
number('a number above 0, at most 100', N, ( N > 0, N =< 100 )).
number('a whole number above 0', N, ( integer(N), N > 0 )).
number('a whole number', N, ( integer(N), N >= 0 )).
number('a whole number below 65536', N, ( integer(N), N >= 0, N < 65536 )).
number('virtual, realtime, or a factor', N, N > 0).

% ---------------- PARSING

%!  command_line(+Arguments, -Command, -Files, -Options) is det.
%
%   Options are terms Name(Value).

command_line([Command|Rest], Command, Files, Options) :-
    (   command(Command, Argument, _)
    ->  true
    ;   findall(Name, command(Name, _, _), Names),
        atomic_list_concat(Names, ', ', Listed),
        throw(usage("there is no command ~w; there are: ~w",
                    [Command, Listed]))
    ),
    split(Rest, Command, Files, Options),
    atomic_list_concat(Words, ' ', Argument),
    (   lacks(Words, Files, Missing)
    ->  (   named(Missing, Kind, _)
        ->  there_are(Kind, Listed),
            ( Kind == exercise -> Article = an ; Article = a ),
            throw(usage("~w needs ~w ~w: ~w",
                        [Command, Article, Kind, Listed]))
        ;   throw(usage("~w needs a ~w", [Command, Missing]))
        )
    ;   beyond(Words, Files, Extra)
    ->  throw(usage("~w does not take ~w", [Command, Extra]))
    ;   member(Option, Options),
        functor(Option, Name, 1),
        needs(Name, Other),
        option(Other, _, _, Commands, _),
        memberchk(Command, Commands),
        \+ setting(Other, Options, _)
    ->  throw(usage("--~w needs --~w", [Name, Other]))
    ;   true
    ).

%   The word for which there is no file; the file for which there is no word.

lacks([Word|Words], Files, Missing) :-
    (   Files = [_|Files1]
    ->  lacks(Words, Files1, Missing)
    ;   \+ memberchk(Word, ['', '[FILE]', '[FOLDER]']),
        single(Word, Missing)
    ).

beyond([''], [Extra|_], Extra) :-
    !.
beyond([], [Extra|_], Extra).
beyond([Word|Words], [_|Files], Extra) :-
    \+ atom_concat(_, '...', Word),
    beyond(Words, Files, Extra).

%   PROGRAM... is PROGRAM, several times.

single(Word, Single) :-
    (   atom_concat(Single0, '...', Word)
    ->  Single = Single0
    ;   Single = Word
    ).

split([], _, [], []).
split([Argument|Arguments], Command, Files, Options) :-
    (   atom_concat(--, Text, Argument)
    ->  atomic_list_concat([Name|Parts], =, Text),
        option_value(Name, Command, Parts, Value, Arguments, Rest),
        Option =.. [Name, Value],
        Options = [Option|Options1],
        split(Rest, Command, Files, Options1)
    ;   Files = [Argument|Files1],
        split(Arguments, Command, Files1, Options)
    ).

option_value(Name, Command, Parts, Value, Arguments, Rest) :-
    (   option(Name, _, Type, Commands, _),
        memberchk(Command, Commands)
    ->  true
    ;   throw(usage("~w has no option --~w", [Command, Name]))
    ),
    (   Type == flag
    ->  (   Parts == []
        ->  Value = true,
            Rest = Arguments
        ;   throw(usage("--~w takes no value", [Name]))
        )
    ;   (   Parts == []
        ->  Arguments = [Text|Rest]
        ;   atomic_list_concat(Parts, =, Text),
            Rest = Arguments
        )
    ->  (   value_of(Type, Text, Value)
        ->  true
        ;   throw(usage("--~w needs ~w, not ~w", [Name, Type, Text]))
        )
    ;   throw(usage("--~w needs ~w", [Name, Type]))
    ).

value_of(Type, Text, Value) :-
    (   number(Type, Number, Condition),
        atom_number(Text, Number),
        Condition
    ->  Value = Number
    ;   Type == 'seeds, as 1-10'
    ->  atomic_list_concat(Ends, -, Text),
        findall(End, ( member(Part, Ends), atom_number(Part, End) ), Numbers),
        (   Numbers = [From, To]
        ->  Value = From-To
        ;   Numbers = [Value]
        )
    ;   number(Type, _, _)
    ->  Type = 'virtual, realtime, or a factor',
        memberchk(Text, [virtual, realtime]),
        Value = Text
    ;   ( Type \== any ; Text == any )
    ->  Value = Text
    ).

%!  setting(+Name, +Options, -Value) is semidet.
%!  setting(+Name, +Options, -Value, +Default) is det.

setting(Name, Options, Value) :-
    Option =.. [Name, Value],
    memberchk(Option, Options).

setting(Name, Options, Value, Default) :-
    (   setting(Name, Options, Given)
    ->  Value = Given
    ;   Value = Default
    ).

%!  no_such(+Kind, +Name)
%
%   Throws that there is no `program`, `exercise`, `world` or `robot` Name.

no_such(Kind, Name) :-
    there_are(Kind, Listed),
    throw(usage("there is no ~w ~w; there are: ~w", [Kind, Name, Listed])).

there_are(Kind, Listed) :-
    named(_, Kind, Folder),
    absolute_file_name(Folder, Directory, [file_type(directory)]),
    (   Kind == exercise
    ->  Ending = '/*/exercise.pl'
    ;   Ending = '/*.pl'
    ),
    atom_concat(Directory, Ending, Pattern),
    expand_file_name(Pattern, Files),
    findall(Name,
            ( member(File, Files),
              (   Kind == exercise
              ->  file_directory_name(File, Path)
              ;   Path = File
              ),
              file_base_name(Path, Base),
              file_name_extension(Name, _, Base) ),
            Names),
    atomic_list_concat(Names, ', ', Named),
    atom_concat(Named, ', or a file', Listed).

%   named(?Argument, ?Kind, ?Folder): where those of the pack are.
named('FILE', program, ev3dev_pack(examples)).
named('EXERCISE', exercise, ev3dev_pack(course)).
named('WORLD', world, library(ev3dev/worlds)).
named('ROBOT', robot, library(ev3dev/robots)).

%!  complain(+Arguments, +Format, +Values) is det.
%
%   Print usage(Format, Values), which Arguments led to.

complain(Arguments, Format, Values) :-
    (   Arguments = [Command|_],
        command(Command, _, _)
    ->  Words = [swipl, App, Command, '--help']
    ;   Words = [swipl, App, '--help']
    ),
    typed(App),
    atomic_list_concat(Words, ' ', Help),
    format(user_error, "ev3dev: ", []),
    format(user_error, Format, Values),
    format(user_error, "~nSee: ~w~n", [Help]).

%   What was typed after `swipl`: Prologs before 9.1.18 have no apps.

typed(App) :-
    (   current_prolog_flag(os_argv, [_|Arguments]),
        member(App, Arguments),
        atom_concat(_, 'ev3dev.pl', App)
    ->  true
    ;   App = ev3dev
    ).

% ---------------- HELP

%!  is_help(+Arguments, -Command) is semidet.
%
%   Arguments ask for help about a Command, or `all`.

is_help([], all).
is_help([First|Rest], Command) :-
    (   memberchk(First, [help, '--help', '-h'])
    ->  ( Rest = [Command|_], command(Command, _, _) -> true
        ; Command = all )
    ;   command(First, _, _),
        member(Word, ['--help', '-h']),
        memberchk(Word, Rest)
    ->  Command = First
    ).

%!  help(+Command) is det.

help(all) :-
    typed(App),
    format("swipl ~w COMMAND [ARGUMENT] [OPTION ...]~n~n", [App]),
    forall(command(Name, Argument, Text), line([Name, ' ', Argument], Text)),
    nl,
    line(['COMMAND --help'], 'the options of a command'),
    line(['--version'], 'of the pack, and of SWI-Prolog'),
    named_line('WORLD'),
    format("~nStatus: 0; 1 if the answer is no, or the program failed;~n\c
            2 if the command line makes no sense.~n", []).
help(Command) :-
    command(Command, Argument, Text),
    line([Command, ' ', Argument], Text),
    findall(Value,
            ( option(Name, Value, _, Commands, Meaning),
              memberchk(Command, Commands),
              line(['--', Name, ' ', Value], Meaning) ),
            Values),
    atomic_list_concat(Words, ' ', Argument),
    append(Words, Values, Shown),
    forall(member(Name, ['FILE', 'EXERCISE', 'WORLD', 'ROBOT']),
           (   memberchk(Name, Shown)
           ->  named_line(Name)
           ;   true
           )).

line(Parts, Text) :-
    atomic_list_concat(Parts, Left),
    format("  ~w~t~28|~w~n", [Left, Text]).

named_line(Name) :-
    named(Name, Kind, _),
    there_are(Kind, Listed),
    format("~n~w: ~w~n", [Name, Listed]).
