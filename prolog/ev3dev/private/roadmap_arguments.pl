:- module(ev3dev_roadmap_arguments,
          [ roadmap_facts/2,            % +Map, -Facts
            roadmap_options/2,          % +Options, -Native
            roadmap_point/2,            % +Point, -Native
            number_option/4             % +Option, +Domain, +Options, +Default
          ]).
:- use_module(errors, [evaluated/2, domain_error/2, must_be/2]).
:- use_module(library(pairs), [pairs_keys/2]).
:- use_module(facts, [located_facts/3]).
:- use_module(arguments, [finite/1, must_be_options/3, option/3]).

/** <module> Arguments of planning and navigation

What library(ev3dev/roadmap) and library(ev3dev/navigation) are told.
*/

%!  roadmap_facts(+Map, -Facts) is det.
%
%   True if Facts is the list of facts of a Map: itself, or that of a world.
%   They are checked when they are used.
%
%   @error existence_error(world, Map)

roadmap_facts(Map, Facts) :-
    must_be(nonvar, Map),
    (   is_list(Map)
    ->  Facts = Map
    ;   located_facts(world, Map, Located),
        pairs_keys(Located, Facts)
    ).

%!  roadmap_options(+Options, -Native) is det.
%
%   True if Native is what native code takes for Options: the distance to
%   keep, the least radius of an arc, the method, how many points to draw and
%   the seed.
%
%   @error as roadmap_path/5

roadmap_options(Options, options(Keep, Arc, Method, Samples, Seed)) :-
    must_be_options(roadmap_option,
                    [radius, margin, method, arc_radius, samples, seed],
                    Options),
    number_option(radius(Radius), positive_number, Options, 8),
    number_option(margin(Margin), nonneg, Options, 4),
    Keep is Radius + Margin,
    number_option(arc_radius(Arc), positive_number, Options, 6),
    option(method(Method), Options, visibility),
    must_be(atom, Method),
    option(samples(Samples), Options, 500),
    must_be(integer, Samples),
    must_be(nonneg, Samples),
    (   Samples =< 100000
    ->  true
    ;   domain_error(samples, Samples)
    ),
    option(seed(Seed), Options, 1),
    must_be(integer, Seed).

%!  number_option(?Option, +Domain, +Options, +Default) is det.
%
%   True if Option, Name(Number), is in Options with an expression of that
%   value; else Number is Default. Domain is `nonneg` or `positive_number`.
%
%   @error domain_error(Domain, Number)

number_option(Option, Domain, Options, Default) :-
    functor(Option, Name, 1),
    functor(Given, Name, 1),
    arg(1, Option, Number),
    arg(1, Given, Value),
    option(Given, Options, Default),
    evaluated(Value, Number),
    (   finite(Number),
        in_domain(Domain, Number)
    ->  true
    ;   domain_error(Domain, Number)
    ).

in_domain(nonneg, Number) :-
    Number >= 0.
in_domain(positive_number, Number) :-
    Number > 0.

%!  roadmap_point(+Point, -Native) is det.
%
%   True if Native is X-Y, both numbers, for a Point that is written X-Y or
%   [X, Y], with arithmetic expressions.
%
%   @error domain_error(point, Point)

roadmap_point(Point, X-Y) :-
    must_be(nonvar, Point),
    (   coordinates(Point, X0, Y0)
    ->  evaluated(X0, X),
        evaluated(Y0, Y)
    ;   domain_error(point, Point)
    ).

coordinates(X-Y, X, Y).
coordinates([X, Y], X, Y).
