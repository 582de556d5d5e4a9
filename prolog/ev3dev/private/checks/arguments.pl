:- module(ev3dev_arguments,
          [ must_be_options/3,          % +Domain, +Names, +Options
            take_options/4,             % +Names, +Options, -Taken, -Rest
            option/2,                   % ?Option, +Options
            option/3,                   % ?Option, +Options, +Default
            number_value/2,             % +Expression, -Number
            number_value/3,             % +Domain, +Expression, -Number
            speed_value/2,              % +Speed, -Value
            speed_unit/3,               % ?Speed, ?Expression, -Factor
            angle_value/2,              % +Angle, -Degrees
            number_option/4,            % ?Option, +Domain, +Options, +Default
            limit_option/2,             % ?Option, +Options
            limit_option/3,             % ?Option, +Options, +Default
            timeout_option/2,           % +Options, -Seconds
            must_be_within/4,           % +Lowest, +Highest, +Domain, +Integer
            word/2                      % +Text, -Atom
          ]).
:- use_module('../errors/domains', [in_range/2]).
:- use_module(checks, [evaluated/2, must_be/2]).
:- use_module('../errors/errors', [domain_error/2, throw_error/3]).

/** <module> Options and numbers of the pack's predicates

An option that a predicate does not have is an error: most likely it is
misspelt.

A measure, such as a length, an angle, a speed or a time, may be an arithmetic
expression, also in an option. A count is an integer.
*/

%!  must_be_options(+Domain, +Names, +Options) is det.
%
%   True if Options is a list of Name(Value) or Name=Value with these Names.
%   An option with more arguments than one is in Names as Name/Arity.
%
%   @error domain_error(Domain, Option) for any other Option

must_be_options(Domain, Names, Options) :-
    must_be(list, Options),
    must_each_be_option(Options, Domain, Names),
    each_once(Options).

must_each_be_option([], _, _).
must_each_be_option([Option|Options], Domain, Names) :-
    must_be_option(Domain, Names, Option),
    must_each_be_option(Options, Domain, Names).

must_be_option(Domain, Names, Option) :-
    must_be(nonvar, Option),
    (   is_option(Option, Names)
    ->  true
    ;   memberchk(Option, Names)
    ->  format(atom(Text), '~w is an option with a value: ~w(Value)',
               [Option, Option]),
        throw_error(domain_error(Domain, Option), _, Text)
    ;   throw_error(domain_error(Domain, Option), _, one_of(Option, Names))
    ).

%   The first of a name counts; a student may believe the last one does.

each_once([]).
each_once([Option|Options]) :-
    (   Options \== [],
        option_name(Option, Name),
        is_given(Options, Name)
    ->  twice(Name)
    ;   true
    ),
    each_once(Options).

option_name(Option, Name) :-
    (   Option = (Name0=_)
    ->  Name = Name0
    ;   functor(Option, Name, 1)
    ).

is_given([Option|Options], Name) :-
    (   option_name(Option, Name)
    ->  true
    ;   is_given(Options, Name)
    ).

twice(Name) :-
    (   current_prolog_flag(ev3dev_hints, Hints),
        memberchk(Hints, [off, false])
    ->  true
    ;   format(atom(Text),
               'the option ~w is given twice: the first one counts', [Name]),
        print_message(warning, ev3dev(hint(Text)))
    ).

is_option(Name=_, Names) :-
    !,
    atom(Name),
    memberchk(Name, Names).
is_option(Option, Names) :-
    compound(Option),
    compound_name_arity(Option, Name, Arity),
    (   Arity =:= 1
    ->  memberchk(Name, Names)
    ;   memberchk(Name/Arity, Names)
    ).

%!  take_options(+Names, +Options, -Taken, -Rest) is det.
%
%   True if Taken are those of Options that are in Names, as for
%   must_be_options/3, and Rest are the others. So a predicate takes its own
%   options, and leaves it to another one to refuse what is left.

take_options(Names, Options, Taken, Rest) :-
    must_be(list, Options),
    taken(Options, Names, Taken, Rest).

taken([], _, [], []).
taken([Option|Options], Names, Taken, Rest) :-
    must_be(nonvar, Option),
    (   is_option(Option, Names)
    ->  Taken = [Option|Taken1],
        Rest = Rest1
    ;   Taken = Taken1,
        Rest = [Option|Rest1]
    ),
    taken(Options, Names, Taken1, Rest1).

%!  option(?Option, +Options) is semidet.
%!  option(?Option, +Options, +Default) is semidet.
%
%   True if Option, a term as Name(Value), is the first of its name in
%   Options; if there is none, Value is Default. Options are such as
%   must_be_options/3 accepts. (Not by library(option): with all that it loads
%   it takes a brick longer than the pack.)

option(Option, Options) :-
    given(Options, Option, Given),
    !,
    Option = Given.

option(Option, Options, Default) :-
    (   given(Options, Option, Given)
    ->  Option = Given
    ;   arg(1, Option, Default)
    ).

given(Options, Option, Given) :-
    functor(Option, Name, Arity),
    functor(Given, Name, Arity),
    first(Options, Given).

first([Option|Options], Given) :-
    (   Option = Given
    ->  true
    ;   Option = (Name=Value),
        functor(Given, Name, 1)
    ->  arg(1, Given, Value)
    ;   first(Options, Given)
    ).

%!  number_value(+Expression, -Number) is det.
%!  number_value(+Domain, +Expression, -Number) is det.
%
%   Number is the value of an arithmetic Expression. It is in the range of
%   Domain, see in_range/2, which is `finite_number` by default.
%
%   @error domain_error(Domain, Number)
%   @error as is/2

number_value(Expression, Number) :-
    number_value(finite_number, Expression, Number).

number_value(Domain, Expression, Number) :-
    evaluated(Expression, Number),
    (   in_range(Domain, Number)
    ->  true
    ;   domain_error(Domain, Number)
    ).

%!  speed_value(+Speed, -Value) is det.
%
%   Value is a number, the percentage that Speed is an expression of, or
%   dps(Number) if Speed is dps(Expression), rps(Expression) or
%   rpm(Expression): degrees or rotations a second, or rotations a minute.

speed_value(Speed, Value) :-
    (   nonvar(Speed),
        speed_unit(Speed, Expression, Factor)
    ->  evaluated(Expression, Number),
        Degrees is Factor * Number,
        Value = dps(Degrees)
    ;   evaluated(Speed, Value)
    ).

%!  speed_unit(?Speed, ?Expression, -Factor) is nondet.
%
%   Speed is Expression in a unit that is Factor degrees a second.

speed_unit(dps(Expression), Expression, 1).
speed_unit(rps(Expression), Expression, 360).
speed_unit(rpm(Expression), Expression, 6).

%!  angle_value(+Angle, -Degrees) is det.
%
%   Degrees is the value of an expression Angle, or of rotations(Expression).

angle_value(Angle, Degrees) :-
    (   nonvar(Angle),
        Angle = rotations(Expression)
    ->  evaluated(Expression, Number),
        Degrees is 360 * Number
    ;   evaluated(Angle, Degrees)
    ).

%!  number_option(?Option, +Domain, +Options, +Default) is det.
%
%   True if Option, Name(Number), is in Options with an expression of that
%   value, as for number_value/3; else Number is the value of Default.

number_option(Option, Domain, Options, Default) :-
    functor(Option, Name, 1),
    functor(Given, Name, 1),
    arg(1, Option, Number),
    arg(1, Given, Expression),
    option(Given, Options, Default),
    number_value(Domain, Expression, Number).

%!  limit_option(?Option, +Options) is det.
%!  limit_option(?Option, +Options, +Default) is det.
%
%   True if Option, Name(Seconds), is in Options with an expression of that
%   value, or `infinite`; if there is none, Seconds is Default, or
%   `infinite`.

limit_option(Option, Options) :-
    limit_option(Option, Options, infinite).

limit_option(Option, Options, Default) :-
    functor(Option, Name, 1),
    functor(Given, Name, 1),
    option(Given, Options, Default),
    arg(1, Given, Expression),
    arg(1, Option, Seconds),
    (   Expression == infinite
    ->  Seconds = infinite
    ;   number_value(seconds, Expression, Seconds)
    ).

%!  timeout_option(+Options, -Seconds) is det.
%
%   True if the option `timeout` in Options is an expression of that value, or
%   `infinite`, which is the default, and what `inf` is.
%
%   @error domain_error(timeout, Seconds) if it is negative

timeout_option(Options, Seconds) :-
    option(timeout(Expression), Options, infinite),
    (   Expression == infinite
    ->  Seconds = infinite
    ;   number_value(timeout, Expression, Seconds0),
        (   Seconds0 > 1.0e300          % as inf
        ->  Seconds = infinite
        ;   Seconds = Seconds0
        )
    ).

%!  must_be_within(+Lowest, +Highest, +Domain, +Integer) is det.
%
%   True if Integer is one from Lowest to Highest.
%
%   @error domain_error(Domain, Integer) if it is another

must_be_within(Lowest, Highest, Domain, Integer) :-
    must_be(integer, Integer),
    (   between(Lowest, Highest, Integer)
    ->  true
    ;   format(atom(Message), 'the integer must be from ~d to ~d, not ~d',
               [Lowest, Highest, Integer]),
        throw_error(domain_error(Domain, Integer), _, Message)
    ).

%!  word(+Text, -Atom) is det.
%
%   Atom is a port, or another word, that a program gives as an atom or a
%   string.
%
%   @error type_error(atom, Text)

word(Text, Atom) :-
    (   atom(Text)
    ->  Atom = Text
    ;   string(Text)
    ->  atom_string(Atom, Text)
    ;   must_be(atom, Text)
    ).
