:- module(undisturbed, [undisturbed/2]).
:- use_module(library(lists), [last/2]).
:- use_module(library(readutil)).

/** <module> The time that something takes, without what a busy machine adds
*/

:- meta_predicate undisturbed(0, -).

%!  undisturbed(:Goal, -Seconds)
%
%   Call Goal once. Seconds is how long that took, without the time in which any
%   program of this machine waited for a processor. Where the kernel does not say
%   that, a minute is a second.

undisturbed(Goal, Seconds) :-
    get_time(Before),
    waited(Waited0),
    once(Goal),
    waited(Waited),
    get_time(After),
    (   number(Waited)
    ->  Seconds is After - Before - (Waited - Waited0)
    ;   Seconds is (After - Before) / 60
    ).

%   As /proc says it, in microseconds: "some avg10=0.00 ... total=2183512328"

waited(Seconds) :-
    catch(( read_file_to_string('/proc/pressure/cpu', Text, []),
            split_string(Text, "\n", "", [Some|_]),
            split_string(Some, "=", "", Parts),
            last(Parts, Last),
            number_string(Microseconds, Last) ),
          error(_, _),
          fail),
    !,
    Seconds is Microseconds / 1000000.
waited(unknown).
