:- module(ev3dev_view,
          [ view/0,
            view/1,                     % +Options
            view_stop/0,
            view_url/1,                 % -Url
            view_mark/1,                % +Term
            view_watch/2,               % +Name, +What
            view_value/2                % +Name, +Number
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/errors,
              [domain_error/2, in_own_name/1, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [must_be_options/3, option/3]).
:- use_module(private/processes/browser, [open_browser/3]).
:- use_module(private/native/native,
              [ view_close_/0, view_expect_/0, view_open_/0, view_value_/2 ]).
:- use_module(private/view/controls, [hands_end/0]).
:- use_module(private/view/jog, [jog_end/0]).
:- use_module(private/view/static_state, [watch_add/2, watches_end/0]).
:- use_module(private/view/log,
              [leave_messages/0, mark/1, watch_messages/0]).
:- use_module(private/view/page,
              [page_settings/2, pages_close/0, pages_serve/3]).
:- use_module(private/view/program, [leave_program/0, watch_program/0]).
:- use_module(private/view/worlds, [worlds_settings/1]).

/** <module> The robot in a browser

Shows the robot live, simulated or real, in a page of a browser beside the
toplevel:

```
?- use_module(library(ev3dev/view)).
?- view.
% The robot is at http://localhost:8033/?t=6f0c...
```

The page shows the world from above with the robot where it is and where it
believes to be, what its sensors see, motors and sensors, the brick, charts
and a log. It stops the robot and its program (the key Escape does, too). In
the simulator it also moves the robot and things, and lets time pass more
slowly, or stand.

The page changes nothing by being open: no simulated time passes, no sensor's
mode changes, and a program does the same as without it.

Only this computer can open the page, and only with the address that view/0
prints, unless view/1 says otherwise.
*/

%!  view is det.
%!  view(+Options) is det.
%
%   Show the robot. Prints the address, and opens it in a browser if there is
%   a display. If it is shown already, prints the address again. Options:
%
%     - port(?Port)
%       The port of the server. Default is 8033 or, if that is not free, any
%       other. A variable becomes the port.
%     - address(+Address)
%       `localhost` (default): only this computer can open the page; `any`:
%       all that know the token can, for example to see a brick from a PC.
%     - token(+Token)
%       The secret word in the address: `auto` (default) makes a new one, else
%       an atom or string of at least eight letters, digits, `_` and `-`.
%     - open(+Boolean)
%       Whether to open a browser. Default is `true` if there is a display.
%     - rate(+Hertz)
%       The most frames in a second for a page, from 1 to 60. Default is 20.
%     - goals(+Boolean)
%       Whether the page may send goals, which can do whatever this program
%       can. Only at `localhost`. Default is `false`.
%
%   @error domain_error(view_port, Port)
%   @error domain_error(view_address, Address)
%   @error domain_error(view_token, Token)
%   @error domain_error(view_rate, Hertz)
%   @error domain_error(view_option, Option) if Option is not an option of
%          this predicate
%   @error permission_error(open, port, Port) if the port is in use
%   @error permission_error(open, goals, any) for goals at all addresses

view :-
    view([]).

view(Options) :-
    must_be_options(view_option,
                    [port, address, token, open, rate, goals], Options),
    port(Options, Port),
    option(address(Address), Options, localhost),
    option(token(Token0), Options, auto),
    option(open(Open), Options, display),
    option(rate(Rate0), Options, 20),
    option(goals(Goals), Options, false),
    must_be_port(Port),
    must_be_address(Address),
    must_be_token(Token0),
    must_be_open(Open),
    evaluated(Rate0, Rate),
    must_be_rate(Rate),
    must_be(boolean, Goals),
    must_be_near(Goals, Address),
    with_mutex(ev3dev_view,
               ensure_served(Port, Address, Token0, Rate, Goals, Url)),
    !,
    (   current_prolog_flag(verbose, silent)
    ->  % Nobody can guess it.
        print_message(help, ev3dev(view(Url)))
    ;   print_message(informational, ev3dev(view(Url)))
    ),
    open_browser(Open, Url, Opened),
    (   Opened == true
    ->  view_expect_
    ;   true
    ).

%   A variable stays one: a default must not be taken for it.
port(Options, Port) :-
    (   memberchk(port(_), Options)
    ->  memberchk(port(Port), Options)
    ;   Port = default
    ).

must_be_port(Port) :-
    (   var(Port)
    ->  true
    ;   Port == default
    ->  true
    ;   must_be(integer, Port),
        (   between(1, 65535, Port)
        ->  true
        ;   domain_error(view_port, Port)
        )
    ).

must_be_address(Address) :-
    must_be(nonvar, Address),
    (   memberchk(Address, [localhost, any])
    ->  true
    ;   domain_error(view_address, Address)
    ).

must_be_token(Token) :-
    must_be(nonvar, Token),
    (   Token == auto
    ->  true
    ;   ( atom(Token) ; string(Token) ),
        atom_codes(Token, Codes),
        length(Codes, Length),
        between(8, 128, Length),
        \+ ( '$member'(Code, Codes),
             \+ token_letter(Code) )
    ->  true
    ;   domain_error(view_token, Token)
    ).

token_letter(Code) :-
    (   between(0'0, 0'9, Code)
    ;   between(0'a, 0'z, Code)
    ;   between(0'A, 0'Z, Code)
    ;   memberchk(Code, `_-`)
    ),
    !.

must_be_open(Open) :-
    (   Open == display
    ->  true
    ;   must_be(boolean, Open)
    ).

must_be_rate(Rate) :-
    (   Rate >= 1,
        Rate =< 60
    ->  true
    ;   domain_error(view_rate, Rate)
    ).

must_be_near(true, any) :-
    !,
    throw_error(permission_error(open, goals, any), view/1,
                'goals(true) is for this computer: address(localhost)').
must_be_near(_, _).

:- dynamic
    serving/2.                          % Port, Url

ensure_served(Port, _Address, _Token, _Rate, _Goals, Url) :-
    serving(Port0, Url),
    !,
    (   var(Port)
    ->  Port = Port0
    ;   true
    ).
ensure_served(Port, Address, Token0, Rate, Goals, Url) :-
    token(Token0, Token),
    page_settings(Rate, Goals),
    worlds_settings(Address),
    start(Port, Address, Token, Served),
    watch_messages,
    watch_program,
    view_open_,
    host_of(Address, Host),
    format(atom(Url), 'http://~w:~w/?t=~w', [Host, Served, Token]),
    assertz(serving(Served, Url)).

start(Wanted, Address, Token, Port) :-
    Wanted == default,
    !,
    (   catch(pages_serve(Address, 8033, Token), error(_, _), fail)
    ->  Port = 8033
    ;   pages_serve(Address, Port, Token)
    ).
start(Port, Address, Token, Port) :-
    pages_serve(Address, Port, Token).

host_of(localhost, localhost).
host_of(any, Host) :-
    (   catch(setup_call_cleanup(
                  open('/proc/sys/kernel/hostname', read, In),
                  read_word(In, Host0),
                  close(In)),
              _, fail)
    ->  Host = Host0
    ;   Host = localhost
    ).

read_word(In, Word) :-
    read_letters(In, Codes),
    atom_codes(Word, Codes).

read_letters(In, Codes) :-
    get_code(In, Code),
    (   Code > 0'\s
    ->  Codes = [Code|Codes1],
        read_letters(In, Codes1)
    ;   Codes = []
    ).

token(auto, Token) :-
    !,
    setup_call_cleanup(
        open('/dev/urandom', read, In, [type(binary)]),
        random_codes(32, In, Codes),
        close(In)),
    atom_codes(Token, Codes).
token(Token0, Token) :-
    atom_codes(Token0, Codes),
    atom_codes(Token, Codes).

random_codes(0, _, []) :-
    !.
random_codes(Count, In, [Code|Codes]) :-
    get_byte(In, Byte),
    Digit is Byte /\ 15,
    char_type(Char, xdigit(Digit)),
    char_code(Char, Code),
    Count1 is Count - 1,
    random_codes(Count1, In, Codes).

:- multifile prolog:message//1.

prolog:message(ev3dev(view(Url))) -->
    [ 'The robot is at ~w'-[Url] ].

%!  view_stop is det.
%
%   Close all pages, and end the server. Does nothing if there is none.

view_stop :-
    with_mutex(ev3dev_view, end).

end :-
    (   retract(serving(_, _))
    ->  leave_messages,
        leave_program,
        jog_end,
        pages_close,
        hands_end,
        watches_end,
        view_close_
    ;   true
    ).

%!  view_url(-Url) is semidet.
%
%   True if Url is the address of the page, with its token. Fails if nothing
%   is shown.

view_url(Url) :-
    serving(_, Url0),
    !,
    Url = Url0.

%!  view_mark(+Term) is det.
%
%   Write Term into the log of the page, with the time. Does nothing but that,
%   so a program may keep its marks.

view_mark(Term) :-
    must_be(nonvar, Term),
    mark(Term).

%!  view_watch(+Name, +What) is det.
%
%   Plot in a chart Name what the page knows: What is a port, for the speed of
%   a motor or the first value of a sensor, or `Port-Attribute` with the
%   attribute `position`, `speed` or `duty_cycle` of a motor, or `value0` to
%   `value3` of a sensor.
%
%   @error domain_error(view_watch, What)

view_watch(Name, What) :-
    must_be(nonvar, Name),
    must_be(nonvar, What),
    format(string(Text), "~w", [Name]),
    (   column(What, Column)
    ->  watch_add(Text, Column)
    ;   domain_error(view_watch, What)
    ).

column(Port0-Attribute0, Column) :-
    !,
    nonvar(Port0),
    nonvar(Attribute0),
    atomic(Attribute0),
    atom_string(Attribute, Attribute0),
    named_port(Port0, Port, Kind),
    attribute(Kind, Attribute, Short),
    format(string(Column), "~w.~w", [Port, Short]).
column(Port0, Column) :-
    named_port(Port0, Port, Kind),
    attribute(Kind, _, Short),
    !,
    format(string(Column), "~w.~w", [Port, Short]).

named_port(Port0, Port, Kind) :-
    ( atom(Port0) ; string(Port0) ),
    !,
    atom_string(Port1, Port0),
    (   atom_concat('ev3-ports:', Port, Port1)
    ->  true
    ;   Port = Port1
    ),
    port_kind(Kind, Ports),
    memberchk(Port, Ports),
    !.

port_kind(motor, [outA, outB, outC, outD]).
port_kind(sensor, [in1, in2, in3, in4]).

attribute(motor, speed, speed).
attribute(motor, position, position).
attribute(motor, duty_cycle, duty).
attribute(sensor, value0, value0).
attribute(sensor, value1, value1).
attribute(sensor, value2, value2).
attribute(sensor, value3, value3).

%!  view_value(+Name, +Number) is det.
%
%   Plot Number in a chart Name, at the present time. Number may be an
%   arithmetic expression. Reads nothing, and takes no time.
%
%   @error type_error(evaluable, Number)

view_value(Name, Number0) :-
    must_be(nonvar, Name),
    evaluated(Number0, Number),
    in_own_name(format(string(Text), "~w", [Name])),
    view_value_(Text, Number).

:- initialization(at_halt(view_stop), now).
