:- module(ev3dev_roadmap_arguments,
          [ roadmap_facts/2,            % +Map, -Facts
            roadmap_options/2,          % +Options, -Native
            sensor_option/2             % +Options, -Sensor
          ]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module(library(pairs), [pairs_keys/2]).
:- use_module('../files/facts', [located_facts/3]).
:- use_module('../checks/arguments',
              [ must_be_options/3, must_be_within/4, number_option/4,
                number_value/2, option/2, option/3, word/2
              ]).

/** <module> Arguments of planning and navigation

The arguments of library(ev3dev/roadmap) and library(ev3dev/navigation).
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
    number_option(margin(Margin), nonnegative_number, Options, 4),
    Keep is Radius + Margin,
    number_option(arc_radius(Arc), positive_number, Options, 6),
    option(method(Method0), Options, visibility),
    word(Method0, Method),
    option(samples(Samples), Options, 500),
    must_be_within(0, 100000, samples, Samples),
    option(seed(Seed), Options, 1),
    must_be(integer, Seed).

%!  sensor_option(+Options, -Sensor) is det.
%
%   True if Sensor is the option sensor(X, Y, Heading): where the ultrasonic
%   sensor is on the robot, and where it looks. The default is the shipped
%   robot's.

sensor_option(Options, sensor(X, Y, Heading)) :-
    (   option(sensor(X0, Y0, Heading0), Options)
    ->  true
    ;   X0 = 0, Y0 = 7, Heading0 = 0
    ),
    number_value(X0, X),
    number_value(Y0, Y),
    number_value(Heading0, Heading).
