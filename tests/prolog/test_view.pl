:- use_module('../support/child').
:- use_module('../support/dev').
:- use_module('../support/trees').
:- use_module('../support/undisturbed').
:- use_module('../support/web').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/view)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/grid_belief)).
:- use_module(library(ev3dev/localize)).
:- use_module(library(ev3dev/map)).
:- use_module(library(ev3dev/rules),
              [after/2, after/3, behave/2, op(1150, xfx, ~>), op(1160, xfx, ::)]).

%   The token of these tests.
token(test_token).

:- meta_predicate
    viewed(?, 0),
    viewed(?, 0, +),
    quietly(0).

%   Call Goal while the view is served at Port.
viewed(Port, Goal) :-
    viewed(Port, Goal, []).

viewed(Port, Goal, Options) :-
    token(Token),
    setup_call_cleanup(
        quietly(view([port(Port), token(Token), open(false)|Options])),
        once(Goal),
        view_stop).

quietly(Goal) :-
    current_prolog_flag(verbose, Verbose),
    setup_call_cleanup(
        set_prolog_flag(verbose, silent),
        once(Goal),
        set_prolog_flag(verbose, Verbose)).

%   Call Goal with a page of the simulated room.
paged(Page, Goal) :-
    token(Token),
    with_sim(room,
             viewed(Port,
                    setup_call_cleanup(page_open(Port, Token, Page),
                                       once(Goal),
                                       page_close(Page)))).

:- meta_predicate paged(?, 0).

%   The first number of what a page has.
film(Frame, Film) :-
    split_string(Frame.have, ".", "", [Film|_]).

marks_stand_after_commands(Page) :-
    page_ask(Page, "next", First),
    forall(( between(1, 20, _), member(Color, [red, green]) ),
           ( led(left, Color), view_mark(Color) )),
    frame(Page, First.have, Frame),
    findall(Kind, ( member(Line, Frame.log), Kind = Line.kind ), Kinds),
    findall(Kind, ( between(1, 40, _), member(Kind, ["command", "mark"]) ),
            Expected),
    Kinds == Expected.

%   In one world, where they look at each other, and the page of both
two_robots(Page, Goal) :-
    paged(Page,
          setup_call_cleanup(
              sim_start([start(anna, 0, 0, 0), start(bob, 0, 60, 180)],
                        [clock(virtual), robots([anna-default, bob-default])]),
              Goal,
              ( use_brick(local),
                forall(member(Name, [anna, bob]), catch(brick_close(Name), _, true)) ))).

:- meta_predicate two_robots(?, 0).

frame(Page, Have, Frame) :-
    format(string(Line), "next ~w", [Have]),
    page_ask(Page, Line, Frame).

:- meta_predicate
    frame_with(+, ?, 0),
    frame_with(+, ?, 0, +).

%   Ask for frames until one satisfies a condition.
frame_with(Page, Frame, Condition) :-
    frame_with(Page, Frame, Condition, 500).

frame_with(Page, Frame, Condition, Left) :-
    Left > 0,
    page_ask(Page, "next", Seen),
    (   \+ \+ ( Frame = Seen, call(Condition) )
    ->  Frame = Seen,
        call(Condition)
    ;   Left1 is Left - 1,
        frame_with(Page, Frame, Condition, Left1)
    ).

%   What a page that has the token sends.
own(Port, [Cookie]) :-
    token(Token),
    cookie(Port, Token, Cookie).

:- begin_tests(view).
test(there_is_no_address_before, fail) :-
    view_url(_).
test(the_address_has_the_token, true(Url == Expected)) :-
    viewed(Port, view_url(Url)),
    format(atom(Expected), 'http://localhost:~w/?t=test_token', [Port]).
test(a_second_start_says_the_same_address, true(Url1 == Url2)) :-
    viewed(Port, ( view_url(Url1),
                   quietly(view([port(Port2), open(false)])),
                   Port2 == Port,
                   view_url(Url2) )).
test(tokens_differ, true(Url1 \== Url2)) :-
    quietly(view([port(Port), open(false)])),
    view_url(Url1),
    view_stop,
    quietly(view([port(Port), open(false)])),
    view_url(Url2),
    view_stop.
test(a_port_that_is_busy, error(permission_error(open, port, Port), _)) :-
    setup_call_cleanup(
        ( tcp_socket(Socket), tcp_bind(Socket, localhost:Port),
          tcp_listen(Socket, 1) ),
        view([port(Port), open(false)]),
        ( tcp_close_socket(Socket), view_stop )).
test(stop_twice) :-
    view_stop,
    view_stop.
test(no_thread_of_the_server_is_left) :-
    findall(Thread, thread_property(Thread, status(running)), Before),
    viewed(Port, get(Port, '/?t=test_token', [], _, _)),
    eventually(threads_are(Before)).

test(nothing_of_the_server_is_left, true(Descriptors == Descriptors0)) :-
    token(Token),
    descriptors(Descriptors0),
    quietly(view([port(Port), token(Token), open(false)])),
    besieged(Port, 20, slow,
             ( page_open(Port, Token, Page),
               page_ask(Page, "next", _),
               \+ \+ of_the_view(_),
               view_stop )),
    page_close(Page),
    descriptors(Descriptors),
    eventually(\+ of_the_view(_)).

descriptors(Count) :-
    directory_files('/proc/self/fd', Files),
    length(Files, Count).

%   A thread that serves the view, as the kernel names it.
of_the_view(Thread) :-
    directory_files('/proc/self/task', Threads),
    member(Thread, Threads),
    atomic_list_concat(['/proc/self/task/', Thread, '/comm'], File),
    catch(setup_call_cleanup(open(File, read, In),
                             read_line_to_string(In, "ev3-view"),
                             close(In)),
          error(_, _), fail).

threads_are(Before) :-
    findall(Thread, thread_property(Thread, status(running)), Now),
    subtract(Now, Before, []).

test(library_loads_no_server) :-
    run_program("", [goal('use_module(library(ev3dev)), \c
                           \\+ current_module(ev3dev_view_page)')], Status, _),
    Status == exit(0).
:- end_tests(view).

:- begin_tests(view_page).
test(a_page_with_the_token) :-
    viewed(Port,
           ( get(Port, '/?t=test_token', [], Code, Answer),
             memberchk(Code, [200, 404]) )),
    (   Code == 200
    ->  has(Answer, "default-src 'self'"),
        has(Answer, "; HttpOnly; SameSite=Strict; "),
        has(Answer, "X-Content-Type-Options: nosniff")
    ;   true
    ).
test(samples_as_a_table, true(Code == 200)) :-
    with_sim(room, viewed(Port, ( own(Port, Fields), wait(1),
                                  get(Port, '/samples.csv', Fields, Code,
                                      Answer) ))),
    has(Answer, "Content-Security-Policy: "),
    has(Answer, "time,x,y,heading,outA.position,outA.speed,outA.duty,"),
    has(Answer, "\n0,40,40,40,0,0,0,"),
    has(Answer, "\n1,40,40,40,0,0,0,").

% Each of these is refused.
refused(403, '/', []).
refused(403, '/samples.csv', []).
refused(403, '/?t=wrong_token', []).
refused(403, '/?t=test_tokem', []).
refused(403, '/?t=', []).
refused(403, '/samples.csv?t=test_token', []).
refused(403, '/samples.csv', ["Cookie: ev3view_1=test_token"]).
refused(403, '/samples.csv', [own, "Host: example.org"]).
refused(403, '/samples.csv', [own, "Host: localhost"]).
refused(403, '/samples.csv', [own, "Host: localhost:1"]).
refused(403, '/?t=test_token', ["Host: localhost.example.org:80"]).
refused(403, '/samples.csv', [own, "Origin: http://example.org"]).
refused(403, '/samples.csv', [own, "Origin: null"]).
refused(403, '/samples.csv', [own, "Origin: http://localhost:1"]).
refused(403, '/ws', [own]).
refused(400, '/ws', [own, origin]).
refused(404, '/missing.js', [own]).
refused(404, '/../view.pl', [own]).
refused(404, '/%2e%2e/view.pl', [own]).
refused(404, '/../../../../../../etc/passwd', [own]).

test(refused, [forall(refused(Code0, Path, Fields0)), true(Code == Code0)]) :-
    with_sim([], viewed(Port, ( fields(Fields0, Port, Fields),
                                get(Port, Path, Fields, Code, _) ))).

method(405, "POST /samples.csv").
method(405, "PUT /").
method(405, "DELETE /stop").
method(405, "GET /stop").

test(method, [forall(method(Code0, Line)), true(Code == Code0)]) :-
    with_sim([], viewed(Port, ( fields([own, origin], Port, Fields),
                                send(Port, Line, Fields, Code) ))).
test(stop_needs_an_origin, true(Code == 403)) :-
    viewed(Port, ( own(Port, Fields),
                   send(Port, "POST /stop", Fields, Code) )).
test(stop_of_another_page, true(Code == 403)) :-
    viewed(Port, ( own(Port, [Cookie]),
                   send(Port, "POST /stop",
                        [Cookie, "Origin: http://example.org"], Code) )).

send(Port, Line, Fields, Code) :-
    string_concat(Line, " HTTP/1.1", First),
    format(string(Host), "Host: localhost:~w", [Port]),
    append([First, Host, "Connection: close", "Content-Length: 0"], Fields,
           Lines),
    request(Port, Lines, Code, _).

% A websocket of another page, and one of another name for this computer.
socket_refused(["Origin: http://example.org", own]).
socket_refused(["Origin: http://localhost:1", own]).
socket_refused([origin]).
socket_refused([origin, "Cookie: ev3view_1=test_token"]).
socket_refused([origin, own, "Host: example.org"]).
socket_refused([own, "Host: example.org:80", "Origin: http://example.org:80"]).

test(socket_refused, [forall(socket_refused(Fields0)), true(Code == 403)]) :-
    viewed(Port, ( fields(Fields0, Port, Fields),
                   page_open(Port, '/ws', Fields, Code, none) )).
test(what_is_no_request_at_all, true(Code == 404)) :-
    viewed(Port, ( no_messages(( request(Port, ["\x01\\x02\garbage"], _, _),
                                 request(Port, ["GET"], _, _) )),
                   own(Port, Fields),
                   get(Port, '/missing', Fields, Code, _) )).
test(a_cookie_that_is_none, true(Code == 403)) :-
    viewed(Port, get(Port, '/', ["Cookie: test_token"], Code, _)).
test(a_line_without_end_takes_no_memory, true(Code == 404)) :-
    length(Codes, 1000000),
    maplist(=(0'x), Codes),
    string_codes(Part, Codes),
    viewed(Port, ( no_messages(( request(Port, ["GET / HTTP/1.1", "X: ", Part], _, _),
                                 request(Port, [Part], _, _) )),
                   own(Port, Fields),
                   get(Port, '/missing', Fields, Code, _) )).
test(other_names_of_this_computer,
     true(Codes == [200, 403, 403, 403])) :-
    token(Token),
    with_sim([],
        viewed(Port,
               ( findall(Code,
                         ( member(Name-Secret, [ '192.168.1.5'-Token,
                                                 'example.org'-Token,
                                                 '192.168.1.256'-Token,
                                                 '192.168.1.5'-other_token ]),
                           format(string(Host), "Host: ~w:~w", [Name, Port]),
                           cookie(Port, Secret, Cookie),
                           get(Port, '/samples.csv', [Host, Cookie], Code, _) ),
                         Codes) ),
               [address(any)])).

fields([], _, []).
fields([Field0|Fields0], Port, [Field|Fields]) :-
    (   Field0 == own
    ->  own(Port, [Field])
    ;   Field0 == origin
    ->  format(string(Field), "Origin: http://localhost:~w", [Port])
    ;   Field = Field0
    ),
    fields(Fields0, Port, Fields).

has(Answer, Part) :-
    sub_string(Answer, _, _, _, Part),
    !.
:- end_tests(view_page).

%   Call Goal, and print nothing.
:- meta_predicate unseen(0).

unseen(Goal) :-
    setup_call_cleanup(
        assertz((user:message_hook(_, _, _) :- true), Hook),
        once(Goal),
        erase(Hook)).

%   Call Goal; fails if anything is printed meanwhile.
:- meta_predicate no_messages(0).
:- dynamic said/1.

no_messages(Goal) :-
    retractall(said(_)),
    setup_call_cleanup(
        asserta((user:message_hook(Message, Kind, _) :-
                     memberchk(Kind, [error, warning]),
                     assertz(user:said(Message)),
                     fail),
                Hook),
        once(Goal),
        erase(Hook)),
    \+ said(_).

:- begin_tests(view_socket).
% What a page must not send, and the code with which it is closed.
fault(1003, [0x82, 0x81, 0, 0, 0, 0, 0'x]).               % binary
fault(1007, [0x81, 0x81, 0, 0, 0, 0, 0xff]).              % no UTF-8
fault(1007, [0x81, 0x82, 0, 0, 0, 0, 0xc0, 0x80]).        % too long
fault(1007, [0x81, 0x83, 0, 0, 0, 0, 0xed, 0xa0, 0x80]).  % surrogate
fault(1002, [0x83, 0x80, 0, 0, 0, 0]).                    % reserved opcode
fault(1002, [0x8b, 0x80, 0, 0, 0, 0]).
fault(1002, [0xc1, 0x80, 0, 0, 0, 0]).                    % reserved bit
fault(1002, [0x81, 0x01, 0'x]).                           % not masked
fault(1002, [0x80, 0x80, 0, 0, 0, 0]).                    % goes on with nothing
fault(1002, [0x09, 0x80, 0, 0, 0, 0]).                    % ping in parts
fault(1002, [0x89, 0xfe, 0, 126, 0, 0, 0, 0]).            % long ping
fault(1009, [0x81, 0xff, 0, 0, 0, 0, 0x17, 0, 0, 0]).     % 385 MB
fault(1009, [0x81, 0xff, 0xff, 0, 0, 0, 0, 0, 0, 0]).
fault(1000, [0x88, 0x80, 0, 0, 0, 0]).                    % it closes itself
fault(1000, [0x88, 0x82, 0, 0, 0, 0, 3, 0xe9]).           % 1001
fault(1000, [0x88, 0x83, 0, 0, 0, 0, 0x0b, 0xb8, 0'x]).   % 3000, a reason
fault(1002, [0x88, 0x81, 0, 0, 0, 0, 3]).                 % half a code
fault(1002, [0x88, 0x82, 0, 0, 0, 0, 3, 0xe7]).           % 999
fault(1002, [0x88, 0x82, 0, 0, 0, 0, 3, 0xed]).           % 1005, never sent
fault(1002, [0x88, 0x82, 0, 0, 0, 0, 0x13, 0x88]).        % 5000
fault(1002, [0x01, 0x81, 0, 0, 0, 0, 0'x, 0x88, 0x81, 0, 0, 0, 0, 3]).
fault(1007, [0x88, 0x83, 0, 0, 0, 0, 3, 0xe8, 0xff]).     % a reason, no UTF-8

test(fault, [forall(fault(Code, Bytes)), true(Answer == close(Code))]) :-
    paged(Page, no_messages(( page_bytes(Page, Bytes),
                              page_hear(Page, Answer) ))).

% Lines that there are not.
no_line(Line) :-
    member(Line,
           [ "", "nothing", "stop now", "place 1 2", "place 1 2 x",
             "place 1 2 0'a", "place 1e400 2 3", "place 1 2  3",
             "place 1 2 1r3", "pace x3", "step 0", "step -1", "step 1000",
             "press escape", "unplug outE", "plug in1 'halt'",
             "add halt 1 2 3", "add box 1 2", "add box 1 2 3 4 mass 1",
             "add beacon 1 2 mass 3", "add circle 1 2 3 mass", "add mass 3",
             "add circle 1 2 3 mass a", "move 1.5 2 3", "save ../x",
             "jog 101 0", "jog 10", "reset now", "choose room",
             "choose world room", "choose lamp pack room", "begin room",
             "write ../x floor(red).", "worlds 1" ]).

test(no_line, [forall(no_line(Line)), true(Answer == close(1008))]) :-
    paged(Page, no_messages(page_ask(Page, Line, Answer))).
test(the_longest_line) :-
    long_text(65000, Text),
    string_concat("mark ", Text, Line),
    paged(Page, page_ask(Page, Line, Answer)),
    Answer.what == "mark".
test(a_line_in_parts) :-
    paged(Page,
          ( page_bytes(Page, [0x01, 0x84, 0, 0, 0, 0, 0'm, 0'a, 0'r, 0'k]),
            page_bytes(Page, [0x89, 0x80, 0, 0, 0, 0]),
            page_bytes(Page, [0x80, 0x82, 0, 0, 0, 0, 0' , 0'x]),
            page_hear(Page, pong),
            page_hear(Page, Answer) )),
    Answer.what == "mark".
test(too_long_in_parts, true(Answer == close(1009))) :-
    long_text(60000, Text),
    string_codes(Text, Codes),
    paged(Page,
          ( append([0x01, 0xfe, 0xea, 0x60, 0, 0, 0, 0], Codes, First),
            append([0x80, 0xfe, 0xea, 0x60, 0, 0, 0, 0], Codes, Second),
            page_bytes(Page, First),
            page_bytes(Page, Second),
            page_hear(Page, Answer) )).
test(goals_are_not_allowed) :-
    paged(Page, page_ask(Page, "goal 1 halt", Answer)),
    Answer.type == "refused".
test(there_are_enough_pages, true(Codes == [503])) :-
    token(Token),
    viewed(Port,
           ( findall(Page, ( between(1, 16, _),
                             page_open(Port, Token, Page) ), Pages),
             forall(member(Page, Pages), page_ask(Page, "next", _)),
             fields_of(Port, Fields),
             page_open(Port, '/ws', Fields, Code, _),
             Codes = [Code],
             maplist(page_close, Pages) )).
test(the_server_starts_again_while_pages_are_open,
     true(Ends-Type == [bye, close(1001)]-"frame")) :-
    token(Token),
    quietly(view([port(Port), token(Token), open(false)])),
    page_open(Port, Token, Page),
    page_ask(Page, "next", _),
    view_stop,
    page_hear(Page, Bye),
    page_hear(Page, Close),
    atom_string(ByeType, Bye.type),
    Ends = [ByeType, Close],
    page_close(Page),
    viewed(Port,
           ( page_open(Port, Token, Page2),
             page_ask(Page2, "next", Frame),
             page_close(Page2) )),
    Type = Frame.type.
test(a_connection_that_says_nothing_holds_nobody_up, true(Took < 3)) :-
    token(Token),
    quietly(view([port(Port), token(Token), open(false)])),
    web:connect(Port, In, Out),
    own(Port, Fields),
    get(Port, '/missing', Fields, 404, _),
    undisturbed(view_stop, Took),
    close(In, [force(true)]),
    close(Out, [force(true)]).
test(a_program_that_was_started_does_not_keep_the_port) :-
    token(Token),
    quietly(view([port(Port), token(Token), open(false)])),
    page_open(Port, Token, Page),
    % Until it has begun it is a copy of this program.
    process_create(path(sh), ['-c', 'echo begun; exec sleep 20'],
                   [ process(Pid), stdout(pipe(Out)) ]),
    read_line_to_string(Out, "begun"),
    close(Out),
    call_cleanup(( view_stop,
                   viewed(Port, true) ),
                 ( process_kill(Pid),
                   process_wait(Pid, _),
                   page_close(Page) )).

fields_of(Port, [Cookie, Origin]) :-
    token(Token),
    cookie(Port, Token, Cookie),
    format(string(Origin), "Origin: http://localhost:~w", [Port]).

long_text(Length, Text) :-
    length(Codes, Length),
    maplist(=(0'x), Codes),
    string_codes(Text, Codes).
:- end_tests(view_socket).

:- begin_tests(view_frame).
test(the_first_frame_has_everything) :-
    paged(Page,
          ( page_ask(Page, "next", Frame),
            Frame.type == "frame",
            Frame.new == true,
            Frame.source == "sim",
            Frame.clock.kind == "virtual",
            Frame.name == "room",
            length(Frame.ports, 8),
            Frame.world.bounds = [_, _, _, _],
            Frame.spec.axle =:= 10.6,
            Frame.screen.w =:= 178,
            Frame.robot.true = [_, _, _] )).
test(a_robot_without_wheels_has_none_on_the_page) :-
    paged(Page,
          ( sim_start([start(5, 6, 90)],
                      [clock(virtual), robot([motor(outA, 'lego-ev3-l-motor', [stops(0, 90)])])]),
            page_ask(Page, "next", Frame),
            Frame.spec.hull.kind == "rectangle",
            \+ get_dict(left, Frame.spec, _),
            \+ get_dict(axle, Frame.spec, _),
            Frame.robot.true = [5, 6, 90] )).
test(the_other_robots_are_seen, true(Others == [["bob", 0, 60, 8]])) :-
    two_robots(Page,
               ( use_brick(anna), page_ask(Page, "next", Frame) )),
    findall([Name, X, Y, R],
            ( member(Other, Frame.others),
              [Name, X, Y, R] = [Other.name, Other.x, Other.y, Other.r] ),
            Others).
test(a_page_chooses_the_brick) :-
    two_robots(Page,
               ( use_brick(anna),
                 page_ask(Page, "next", Frame1),
                 Frame1.bricks = _{names: ["anna", "bob"], shown: "anna"},
                 page_ask(Page, "brick bob", Done),
                 Done.type == "done",
                 frame(Page, Frame1.have, Frame2),
                 Frame2.new == true,
                 Frame2.bricks = _{names: ["anna", "bob"], shown: "bob"},
                 Frame2.robot.true = [0, 60, 180],
                 [Other] = Frame2.others,
                 Other.name == "anna",
                 page_ask(Page, "place 0 70 90", _),
                 with_brick(bob, sim_pose(0.0, 70.0, 90.0)),
                 use_brick(bob), use_brick(anna),
                 page_ask(Page, "next", Frame3),
                 Frame3.bricks.shown == "bob",
                 brick_close(bob),
                 page_ask(Page, "next", Frame4),
                 Frame4.robot.true = [0, 0, 0] )).
test(both_robots_have_samples_from_the_start) :-
    two_robots(Page,
               ( page_ask(Page, "brick bob", _),
                 use_brick(anna),
                 with_brick(bob, motor_run(outB, 20)),
                 wait(2),
                 page_ask(Page, "next", Frame),
                 length(Frame.samples.rows, Rows),
                 Rows > 10 )).
test(there_is_no_such_brick) :-
    two_robots(Page,
               ( page_ask(Page, "brick eve", Answer),
                 Answer.why == "There is no brick eve." )).
test(one_brick_is_no_choice) :-
    paged(Page,
          ( page_ask(Page, "next", Frame),
            Frame.bricks == null )).
test(the_next_frame_has_what_is_new) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            wait(1),
            frame(Page, First.have, Frame),
            \+ get_dict(new, Frame, _),
            \+ get_dict(world, Frame, _),
            \+ get_dict(screen, Frame, _),
            length(Frame.samples.rows, Count),
            Count > 0,
            frame(Page, Frame.have, Last),
            \+ get_dict(samples, Last, _) )).
test(samples_are_a_film, true(Times == Expected)) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            motor_run(outB, 50),
            wait(1),
            frame(Page, First.have, Frame) )),
    findall(Time, ( member([Time|_], Frame.samples.rows), Time =< 1 ), Times),
    findall(T, ( between(1, 20, N), T is N/20 ), Expected).
test(another_simulation_is_another_film) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            sim_start([bounds(0, 0, 100, 100), start(50, 50, 0)],
                      [clock(virtual)]),
            frame(Page, First.have, Frame),
            Frame.new == true,
            Frame.world.bounds == [0, 0, 100, 100] )).
test(marks_and_values_and_warnings) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            view_mark(hello(_)),
            view_value(error, 1+0.5),
            unseen(print_message(warning, format("beware ~w", [x]))),
            frame(Page, First.have, Frame),
            Frame.log = [Mark, Warning],
            Mark.kind == "mark",
            Mark.text == "hello(_)",
            Warning.kind == "warning",
            Warning.text == "beware x",
            Frame.values = [["error", _, 1.5]],
            frame(Page, Frame.have, Last),
            \+ get_dict(log, Last, _),
            \+ get_dict(values, Last, _) )).
% In the order in which they were, and not only those that command something.
test(rules_and_events_that_begin, true(Kinds == Expected)) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            set_robot(5.6, 10.6, outB, outC),
            ev3_time(T0),
            after(0.1, true, [id(tick)]),
            behave([ ( drive :: ev3_time(T), T < T0 + 0.3 ~> go(20) ),
                     ( look :: true ~> wait(0.1) ) ],
                   [timeout(0.35)]),
            frame(Page, First.have, Frame) )),
    findall(Kind-Start,
            ( member(Line, Frame.log),
              Kind = Line.kind,
              split_string(Line.text, " ", ",", [A, B|_]),
              memberchk(A, ["rule", "event", "outB"]),
              string_concat(A, " ", A1),
              string_concat(A1, B, Start) ),
            Kinds),
    memberchk(Drive, Frame.log),
    Drive.kind == "rule",
    once(sub_string(Drive.text, _, _, _, "rule drive, ev3_time")),
    Expected = [ "rule"-"rule drive", "command"-"outB runs",
                 "rule"-"event tick", "rule"-"rule look",
                 "command"-"outB was" ].
% As why/1 says them; a pose that is set moves nothing.
test(commands_in_words, true(Texts == Expected)) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            set_robot(5.6, 10.6, outB, outC),
            set_pose(60, 50, 0),
            motor_run(outA, 30),
            motor_run(outA, 50, 360),
            go_cm(30, 5),
            led(left, green),
            ev3_time(Before),
            frame(Page, First.have, Frame),
            ev3_time(After),
            After =:= Before )),
    findall(Text, ( member(Line, Frame.log), Line.kind == "command",
                    Text = Line.text ), Texts),
    Expected = [ "outA runs at 30 %", "outA was turned by 360 degrees at 50 %",
                 "the robot goes 5 cm at 30 %", "the robot stands still (reached)",
                 "the light left is green" ].
% Two threads write the log: what one takes from the journal stands before what
% the other writes next.
test(a_mark_stands_after_the_command_before_it) :-
    paged(Page,
          ( sim_start(room, [clock(realtime)]),
            thread_create(( repeat,
                            ev3dev_view_log:log_commands(false),
                            fail ),
                          Other),
            call_cleanup(forall(between(1, 10, _),
                                marks_stand_after_commands(Page)),
                         ( thread_signal(Other, throw(over)),
                           thread_join(Other, _) )) )).
test(numbers_are_short, true(Numbers == [0.3, -0.05, 2, null, 0.333333])) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            forall(member(Number, [0.1+0.2, -0.05, 2.0, 1.0e300, 1/3.0]),
                   view_value(number, Number)),
            frame(Page, First.have, Frame) )),
    findall(Number, member([_, _, Number], Frame.values), Numbers).
test(texts_of_all_letters, true(Texts == ["a\"b\\c\n</script>\u00e9\u20ac"])) :-
    paged(Page,
          ( page_ask(Page, "next", First),
            view_mark("a\"b\\c\n</script>\u00e9\u20ac"),
            frame(Page, First.have, Frame) )),
    findall(Text, ( member(Line, Frame.log), Text = Line.text ), Texts).
test(watches, true(Watches == Expected)) :-
    paged(Page,
          ( view_watch(left, outB),
            view_watch("way", outB-position),
            view_watch(eye, in1),
            page_ask(Page, "next", Frame) )),
    findall(Name-Column, ( member(Watch, Frame.watches),
                           Name = Watch.name, Column = Watch.column ),
            Watches),
    Expected = ["left"-"outB.speed", "way"-"outB.position", "eye"-"in1.value0"].
test(a_watch_of_nothing, error(domain_error(view_watch, outE), _)) :-
    view_watch(x, outE).
test(a_watch_of_no_attribute,
     error(domain_error(view_watch, outA-color), _)) :-
    view_watch(x, outA-color).
test(a_value_that_is_none, error(type_error(evaluable, _), _)) :-
    view_value(x, high).
test(what_the_robot_believes_is_laid_on_the_world) :-
    paged(Page,
          ( set_robot(5.6, 10.6, outB, outC),
            go_cm(20, 20),
            page_ask(Page, "next", Frame),
            Frame.robot.true = [X, Y, _],
            Frame.robot.believed.pose = [BX, BY, _],
            near(X, BX, 2), near(Y, BY, 2),
            Frame.robot.believed.odometry = [_, OY, _],
            near(OY, 20, 2) )).
test(a_pose_in_the_world_is_as_it_is, true(Believed == [41, 42, 40])) :-
    paged(Page,
          ( set_robot(5.6, 10.6, outB, outC),
            set_pose(41, 42, 40),
            page_ask(Page, "next", Frame),
            Believed = Frame.robot.believed.pose )).
test(the_grid_that_the_program_knows) :-
    token(Token),
    with_sim(grid,
        viewed(Port,
               ( set_robot(5.6, 10.6, outB, outC),
                 set_grid([bounds(0, 0, 3, 2), origin(10, 10)]),
                 obstacle_add([1, 2]),
                 page_open(Port, Token, Page),
                 page_ask(Page, "next", Frame),
                 page_close(Page) ))),
    Frame.grid.cols =:= 4,
    Frame.grid.rows =:= 3,
    Frame.grid.blocked == [[1, 2]],
    Frame.grid.plan == [].
test(the_plan_that_is_carried_out, true(Plan-After == [[0,0],[0,1],[0,2],[1,2]]-[])) :-
    token(Token),
    with_sim(grid,
        viewed(Port,
               ( set_robot(5.6, 10.6, outB, outC),
                 set_grid([bounds(0, 0, 3, 2), origin(10, 10)]),
                 page_open(Port, Token, Page),
                 after(0.5, remember_plan(Page)),
                 execute_plan([move, move, right, move]),
                 nb_getval(plan, Plan),
                 frame_with(Page, Last, Last.grid.plan == []),
                 After = Last.grid.plan,
                 page_close(Page) ))).
%   The page is opened late: a slow machine scans for minutes, and nothing answers a ping then.
test(where_it_may_be, true(Ended == null)) :-
    token(Token),
    with_sim(room,
        viewed(Port,
               ( set_robot(5.6, 10.6, outB, outC),
                 localize_start(room), localize_scan,
                 page_open(Port, Token, Page),
                 frame_with(Page, Frame, Frame.localized \== null),
                 localize_stop,
                 frame_with(Page, Last, Last.localized == null),
                 Ended = Last.localized,
                 page_close(Page) ))),
    Frame.localized.clusters = [First|_],
    First.weight > 0.9,
    [X, Y, _] = First.pose,
    near(X, 40, 5),
    near(Y, 40, 5),
    Frame.localized.confidence > 0.8,
    length(Frame.localized.particles, Count),
    between(100, 400, Count),
    forall(member([PX, PY, _], Frame.localized.particles),
           ( PX >= 0, PX =< 300, PY >= 0, PY =< 250 )).
test(the_map_that_it_makes) :-
    paged(Page,
          ( set_robot(5.6, 10.6, outB, outC),
            map_start, turn(30, 360, []),
            frame_with(Page, Frame, Frame.map \== null) )),
    Map = Frame.map,
    Map.cell =:= 5,
    % Odometry begins at 0, 0, though the robot stands at 40, 40, and looks to 40 degrees.
    Map.h =:= 40,
    length(Map.cells, Count),
    Count > 300,
    forall(member([C, R, P], Map.cells), ( C >= 0, R >= 0, P >= 0, P =< 1 )).
test(the_belief_on_the_grid, true(After == null)) :-
    token(Token),
    with_sim(grid,
        viewed(Port,
               ( set_robot(5.6, 10.6, outB, outC),
                 page_open(Port, Token, Page),
                 grid_map([bounds(0, 0, 7, 7), obstacles([[1, 1], [0, 3]])], Map),
                 retractall(belief_seen(_)),
                 ignore(grid_localize(Map, _, [actions(0), tell(remember_belief(Page))])),
                 belief_seen(Frame),
                 frame_with(Page, Last, Last.belief == null),
                 After = Last.belief,
                 page_close(Page) ))),
    Belief = Frame.belief,
    [Belief.cell, Belief.origin, Belief.h] == [20, [-10, -10], 0],
    length(Belief.cells, 62),
    \+ memberchk([1, 1, _], Belief.cells),
    aggregate_all(max(P), member([_, _, P], Belief.cells), Most),
    Most =:= 1.
remember_belief(Page, _, _) :-
    frame_with(Page, Frame, Frame.belief \== null),
    assertz(belief_seen(Frame)).
remember_plan(Page) :-
    page_ask(Page, "next", Frame),
    nb_setval(plan, Frame.grid.plan).

test(without_a_simulation_nothing_is_chosen) :-
    ignore(sim_stop),
    token(Token),
    viewed(Port,
           ( page_open(Port, Token, Page),
             page_ask(Page, "next", Frame),
             page_close(Page) )),
    memberchk(Frame.source, ["none", "brick"]).
:- end_tests(view_frame).

:- begin_tests(view_hands).
% What a hand says, and whether it is done.
hand("place 100 100 90", "done").
hand("place 0 0 0", "refused").
hand("press enter", "done").
hand("press in1", "refused").
hand("unplug outA", "done").
hand("unplug outD", "refused").
hand("plug outA", "refused").
hand("plug outD lego-ev3-m-motor", "done").
hand("plug outD lego-ev3-us", "refused").
hand("hold outB", "done").
hand("free outB", "done").
hand("hold in1", "refused").
hand("free in1", "refused").
hand("add box 150 150 20 10 45", "done").
hand("add box 40 40 20 20", "refused").
hand("add box 150 150 6 6 0 mass 0.05", "done").
hand("add circle 150 150 6 mass 0.05", "done").
hand("add circle 150 150 6 mass 0", "refused").
hand("add box 40 40 6 6 0 mass 0.05", "refused").
hand("add beacon 10 10 7", "refused").
hand("move 99 10 10", "refused").
hand("remove 99", "refused").
hand("save a", "done").
hand("restore b", "refused").
hand("forget b", "refused").
hand("pace x10", "done").
hand("pause", "done").
hand("step", "done").
hand("resume", "done").
hand("go", "done").
hand("jog 10 10", "refused").

test(hand, [forall(hand(Line, Type)), true(Type1 == Type)]) :-
    paged(Page, page_ask(Page, Line, Answer)),
    Type1 = Answer.type.
test(the_robot_is_placed, true([X, Y, H] == [100.0, 110.0, 90.0])) :-
    paged(Page, ( page_ask(Page, "place 100 110 90", _),
                  sim_pose(X, Y, H) )).
test(a_key_is_pressed_and_released) :-
    paged(Page, ( page_ask(Page, "press enter", _),
                  button(enter),
                  page_ask(Page, "release enter", _),
                  \+ button(enter) )).
test(a_wire_is_pulled_and_put_back) :-
    paged(Page, ( page_ask(Page, "unplug outA", _),
                  wait(1),
                  \+ tacho_motor(outA),
                  page_ask(Page, "next", Frame),
                  Frame.ports = [Port|_],
                  Port.kind == "gone",
                  page_ask(Page, "plug outA", _),
                  wait(2),
                  tacho_motor(outA) )).
test(a_thing_is_added_moved_and_removed) :-
    paged(Page, ( page_ask(Page, "add circle 150 150 10", Added),
                  Id = Added.id,
                  format(string(Move), "move ~w 160 150", [Id]),
                  page_ask(Page, Move, Moved),
                  Moved.id =:= Id,
                  page_ask(Page, "next", Frame),
                  once(( member(Item, Frame.world.items),
                         Item.id =:= Id )),
                  Item.x =:= 160,
                  sim_remove(circle(160, 150, 10)) )).
test(a_snapshot_brings_the_robot_back, true([X, Y] == [40.0, 40.0])) :-
    paged(Page, ( page_ask(Page, "save start", _),
                  motor_run(outB, 50),
                  wait(1),
                  page_ask(Page, "restore start", _),
                  sim_pose(X, Y, _) )).
test(there_are_enough_snapshots) :-
    paged(Page, ( forall(between(1, 16, N),
                         ( format(string(Line), "save s~w", [N]),
                           page_ask(Page, Line, Done),
                           Done.type == "done" )),
                  page_ask(Page, "save s17", Answer) )),
    Answer.type == "refused".
test(a_program_waits_while_time_is_paused, true(Paused-Stood == true-true)) :-
    token(Token),
    with_sim(room,
        viewed(Port,
               ( page_open(Port, Token, Page),
                 page_ask(Page, "pause", _),
                 thread_self(Me),
                 thread_create(watch_pause(Page, Me), Id, []),
                 wait(0.3),
                 thread_join(Id, _),
                 page_close(Page),
                 thread_get_message(paused(Paused, Stood)) ))).

%   The program can wait no longer than this lets it.
watch_pause(Page, Main) :-
    ev3dev_native:view_thread_(true),
    page_ask(Page, "next", Frame1),
    page_ask(Page, "step 0.1", _),
    frame_with(Page, Frame2, Frame2.clock.time >= 0.1),
    Time = Frame2.clock.time,
    (   Time < 0.15
    ->  Stood = true
    ;   Stood = Time
    ),
    page_ask(Page, "resume", _),
    thread_send_message(Main, paused(Frame1.clock.paused, Stood)),
    ev3dev_native:view_thread_(false).
:- end_tests(view_hands).

:- begin_tests(view_same).
% A run is byte for byte the same, watched or not.
test(six_pages_change_nothing, true(Watched == Alone)) :-
    token(Token),
    with_sim(room, run(Alone), [noise(true), seed(7)]),
    viewed(Port,
           ( findall(Id, ( between(1, 6, _),
                           thread_create(looks(Port, Token), Id, []) ), Ids),
             length(Ids, Count),
             forall(between(1, Count, _), thread_get_message(looks)),
             with_sim(room, run(Watched), [noise(true), seed(7)]),
             forall(member(Id, Ids), thread_send_message(Id, enough)),
             maplist(thread_join, Ids, Ends) ),
           [rate(60)]),
    Ends = [true, true, true, true, true, true].

run(Seen) :-
    set_robot(5.6, 10.6, outB, outC),
    go_cm(30, 30),
    turn(30, 90),
    findall(D, ( between(1, 20, _), us_dist_cm(in1, D), wait(0.05) ), Ds),
    motor_run(outA, 50, 90),
    sim_pose(X, Y, H),
    sim_time(T),
    sim_trace(Trace),
    format(string(Seen), "~q", [run(Ds, X, Y, H, T, Trace)]).

looks(Port, Token) :-
    ev3dev_native:view_thread_(true),
    page_open(Port, Token, Page),
    page_ask(Page, "next", Frame),
    page_ask(Page, "program", Text),
    Text.type == "done",
    thread_send_message(main, looks),
    look_on(Page, Frame.have),
    page_close(Page),
    ev3dev_native:view_thread_(false).

look_on(Page, Have) :-
    frame(Page, Have, Frame),
    (   thread_peek_message(enough)
    ->  true
    ;   look_on(Page, Frame.have)
    ).
:- end_tests(view_same).

% A toplevel in a process of its own, with few descriptors, and a page of it.
:- meta_predicate with_toplevel(?, 0).

with_toplevel(top(In, Out, Page), Goal) :-
    child:library_directory_under_test(Library),
    child:swipl(Swipl),
    token(Token),
    format(string(Start),
           "asserta(user:file_search_path(library, ~q)), \c
            set_prolog_flag(ev3dev_hints, off), \c
            use_module(library(ev3dev)), use_module(library(ev3dev/sim)), \c
            use_module(library(ev3dev/view)), \c
            sim_start([], [clock(virtual)]), \c
            view([port(P), token(~q), open(false), goals(true)]), \c
            format('port ~~w~~n', [P]), flush_output", [Library, Token]),
    setup_call_cleanup(
        process_create(path(sh),
                       [ '-c', 'ulimit -n 256; exec "$0" "$@"',
                         Swipl, '-q', '-f', none, '-g', Start ],
                       [ process(Pid), stdin(pipe(In)), stdout(pipe(Out)),
                         stderr(pipe(Err)) ]),
        ( read_line_to_string(Out, Line),
          split_string(Line, " ", "", ["port", Port0]),
          number_string(Port, Port0),
          nb_setval(view_port, Port),
          page_open(Port, Token, Page),
          once(Goal),
          page_close(Page),
          format(In, "halt.~n", []),
          flush_output(In),
          read_stream_to_codes(Err, _),
          process_wait(Pid, exit(0)) ),
        ( catch(process_kill(Pid, kill), _, true),
          close(In, [force(true)]), close(Out), close(Err) )).

query(top(In, _, _), Text) :-
    format(In, "~w~n", [Text]),
    flush_output(In).

%   The same with a robot in the room, and the first frame of the page.
:- meta_predicate in_room(?, ?, 0).

in_room(Top, Frame, Goal) :-
    with_toplevel(Top,
        ( query(Top, "sim_start(room, [clock(virtual), seed(7)]), \c
                      set_robot(5.6, 10.6, outB, outC)."),
          Top = top(_, _, Page),
          frame_with(Page, Frame, ( Frame.name == "room", ended(Frame) ), 2000),
          call(Goal) )).

done(Page, Line) :-
    page_ask(Page, Line, Answer),
    (   Answer.type == "done"
    ->  true
    ;   throw(answered(Line, Answer))
    ).

refused(Page, Line, Part) :-
    page_ask(Page, Line, Answer),
    (   Answer.type == "refused",
        sub_string(Answer.why, _, _, _, Part)
    ->  true
    ;   throw(answered(Line, Answer))
    ).

%   What it prints, up to a line with that text.
printed(Top, Text) :-
    printed(Top, Text, _).

printed(top(_, Out, _), Text, Line) :-
    read_line_to_string(Out, Line0),
    Line0 \== end_of_file,
    (   sub_string(Line0, _, _, _, Text)
    ->  Line = Line0
    ;   printed(top(_, Out, _), Text, Line)
    ).

frame_runs(Frame) :-
    member(Port, Frame.ports),
    get_dict(state, Port, States),
    memberchk("running", States),
    !.

ended(Frame) :-
    Frame.program.state == "idle",
    Frame.program.latched == false.

drives(Page, Y0, Left) :-
    Left > 0,
    page_say(Page, "jog 40 40"),
    page_ask(Page, "next", Frame),
    (   Frame.type == "frame",
        Frame.robot.true = [_, Y, _],
        Y > Y0 + 1
    ->  true
    ;   Left1 is Left - 1,
        drives(Page, Y0, Left1)
    ).

:- begin_tests(view_stop).
% Programs that must be stopped, whatever they do.
program("motor_run(outA, 50), repeat, fail.").
program("motor_run(outA, 50), repeat, position(outA, _), fail.").
program("motor_run(outA, 50), repeat, catch(motor_run(outA, 40), _, true), fail.").
program("repeat, catch((motor_run(outA, 40), wait(0.1)), _, true), fail.").
program("motor_run(outA, 50), wait(1000000).").
program("motor_run(outA, 50), sleep(1000).").
program("motor_run(outA, 50), thread_get_message(nothing).").
program("motor_run(outA, 50), X is 7**3000000 mod 3, write(X).").
program("motor_run(outA, 50), setup_call_cleanup(true, wait(1000000), motor_run(outB, 50)).").
program("thread_create((repeat, motor_run(outA, 50), wait(0.1), fail), _, []), thread_get_message(x).").

test(program, [forall(program(Text))]) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, Text),
          frame_with(Page, Frame, frame_runs(Frame), 2000),
          page_ask(Page, "stop", Stopped),
          Stopped.what == "stop",
          frame_with(Page, Last, ended(Last), 5000),
          \+ frame_runs(Last),
          query(Top, "writeln(alive)."),
          printed(Top, "alive"),
          page_ask(Page, "next", Frame2),
          \+ frame_runs(Frame2) )).
test(a_program_that_begins_is_stopped) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, "assertz((endless :- repeat, sleep(0.1), fail))."),
          query(Top, "asserta((user:expand_query(endless, _, _, _) :- \c
                               writeln(expands), flush_output, sleep(1), \c
                               fail))."),
          query(Top, "endless."),
          printed(Top, "expands"),
          page_ask(Page, "stop", _),
          frame_with(Page, Frame, ended(Frame), 5000),
          query(Top, "writeln(alive), flush_output."),
          printed(Top, "alive") )).
% The first STOP still waits for the end of a thread that tidies up.
test(the_next_program_is_stopped_while_the_first_stop_is_under_way) :-
    tmp_file(tidy, Tidy),
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          format(string(Slow),
                 "thread_create(setup_call_cleanup( \c
                      motor_run(outA, 5), \c
                      ( writeln(slow), flush_output, repeat, sleep(0.01), fail ), \c
                      ( repeat, sleep(0.01), exists_file(~q) )), _, []).",
                 [Tidy]),
          query(Top, Slow),
          printed(Top, "slow"),
          forall(member(Program, [first, second]),
                 ( format(string(Goal),
                          "writeln(~w), flush_output, repeat, sleep(0.01), fail.",
                          [Program]),
                   query(Top, Goal),
                   printed(Top, Program),
                   page_ask(Page, "stop", _) )),
          setup_call_cleanup(
              ( open(Tidy, write, Out), close(Out) ),
              frame_with(Page, Last, ended(Last), 5000),
              delete_file(Tidy)),
          query(Top, "view_mark(alive)."),
          frame_with(Page, Frame,
                     ( member(Line, Frame.log), Line.text == "alive" ), 500) )).
test(a_request_stops_the_program, true(Code == 200)) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, "motor_run(outA, 50), repeat, wait(0.1), fail."),
          frame_with(Page, Frame, frame_runs(Frame), 2000),
          nb_getval(view_port, Port),
          token(Token),
          cookie(Port, Token, Cookie),
          format(string(Host), "localhost:~w", [Port]),
          string_concat("Host: ", Host, HostLine),
          string_concat("Origin: http://", Host, Origin),
          request(Port, [ "POST /stop HTTP/1.1", HostLine, Origin, Cookie,
                          "Connection: close", "Content-Length: 0" ], Code, _),
          frame_with(Page, Last, ended(Last), 5000),
          \+ frame_runs(Last) )).
test(strangers_delay_neither_a_page_nor_stop,
     [ forall(( member(Kind, [ silent, slow, endless, no_token, wrong_token,
                               websocket ]),
                member(Count, [8, 60, 1000]) )),
       true(Code-Late == 200-[])
     ]) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          nb_getval(view_port, Port),
          query(Top, "motor_run(outA, 50)."),
          frame_with(Page, Frame, frame_runs(Frame), 2000),
          besieged(Port, Count, Kind,
                   ( undisturbed(get(Port, '/?t=test_token', [], Code, _), Visit),
                     undisturbed(page_ask(Page, "next", _), Next),
                     undisturbed(page_ask(Page, "stop", _), Stop),
                     frame_with(Page, Last, ( ended(Last), \+ frame_runs(Last) ),
                                2000) )) )),
    findall(Late0, ( member(Late0, [Visit, Next, Stop]), Late0 > 4 ), Late).
test(strangers_leave_descriptors_for_the_motors) :-
    with_toplevel(Top,
        ( nb_getval(view_port, Port),
          besieged(Port, 1000, silent,
                   ( query(Top, "forall(member(M, [outA, outB]), motor_run(M, 50)), \c
                                 writeln(runs)."),
                     printed(Top, "runs") )) )).
test(a_goal_has_answers) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          frame_with(Page, Frame, ended(Frame), 2000),
          page_ask(Page, "goal 1 member(X, [a, f(_)])", First),
          First.state == "more", First.text == "X = a", First.n =:= 1,
          page_ask(Page, "more 1", Second),
          Second.state == "last",
          page_ask(Page, "goal 2 fail.", Third),
          Third.state == "false",
          page_ask(Page, "goal 3 atom_length(_, _)", Fourth),
          Fourth.state == "error",
          page_ask(Page, "goal 4 p(", Fifth),
          Fifth.state == "error" )).
test(a_page_drives_while_no_program_runs) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, "set_robot(5.6, 10.6, outB, outC)."),
          frame_with(Page, Frame, ended(Frame), 2000),
          Frame.robot.true = [_, Y0, _],
          drives(Page, Y0, 200),
          frame_with(Page, Last, \+ frame_runs(Last), 2000) )).
test(at_the_prompt_nothing_is_aborted) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, "motor_run(outA, 50), writeln(begun)."),
          printed(Top, "begun"),
          frame_with(Page, Frame, ( frame_runs(Frame), ended(Frame) ), 2000),
          page_ask(Page, "stop", _),
          page_ask(Page, "stop", _),
          frame_with(Page, Last, ended(Last), 2000),
          \+ frame_runs(Last),
          query(Top, "motor_run(outA, 30), writeln(again)."),
          printed(Top, "again"),
          frame_with(Page, Again, frame_runs(Again), 2000) )).
test(a_thread_that_drives_is_stopped_at_the_prompt, true) :-
    with_toplevel(Top,
        ( Top = top(_, _, Page),
          query(Top, "thread_create((repeat, motor_run(outA, 50), wait(0.1), fail), _, [])."),
          frame_with(Page, Frame, ( frame_runs(Frame), ended(Frame) ), 2000),
          page_ask(Page, "stop", _),
          frame_with(Page, Last, ended(Last), 2000),
          query(Top, "wait(1), writeln(alive)."),
          printed(Top, "alive"),
          page_ask(Page, "next", Frame2),
          \+ frame_runs(Frame2) )).
:- end_tests(view_stop).

%   A folder of its own, and files in it.
:- meta_predicate in_folder(-, 0).

in_folder(Folder, Goal) :-
    tmp_file(worlds, Folder),
    make_directory(Folder),
    setup_call_cleanup(true, once(Goal), delete_directory_and_contents(Folder)).

file_with(Folder, Name, Text) :-
    atomic_list_concat([Folder, /, Name], File),
    setup_call_cleanup(open(File, write, Out), write(Out, Text), close(Out)).

file_text(Folder, Name, Text) :-
    atomic_list_concat([Folder, /, Name], File),
    setup_call_cleanup(open(File, read, In), read_string(In, _, Text), close(In)).

:- begin_tests(view_source).
%   A toplevel in the room that has loaded a program, and its lines.
:- meta_predicate with_program(?, +, -, 0).

with_program(Top, Text, File, Goal) :-
    in_folder(Folder,
        ( file_with(Folder, 'program.pl', Text),
          atomic_list_concat([Folder, '/program.pl'], File),
          in_room(Top, _,
            ( format(string(Load), "consult(~q), writeln(loaded).", [File]),
              query(Top, Load),
              printed(Top, "loaded"),
              call(Goal) )) )).

square("start :-\n    side(4).\n\nside(0) :- !.\nside(N) :-\n    wait_a_little,\n    turn(30, 90),\n    N1 is N-1,\n    side(N1).\n\nwait_a_little :-\n    repeat, wait(0.01), fail.\n").

test(without_a_program_there_is_no_text) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          refused(Page, "program", "No program is loaded."),
          refused(Page, "program /etc/passwd", "no file of the program"),
          done(Page, "program off") )).
test(what_is_plugged_in_while_no_program_runs_is_there_at_once) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          done(Page, "unplug outB"),
          done(Page, "plug outB"),
          query(Top, "motor_run(outB, 20), writeln(runs)."),
          printed(Top, "runs") )).
test(the_text_of_the_program_and_where_it_is) :-
    square(Text),
    with_program(Top, Text, File,
        ( Top = top(_, _, Page),
          page_ask(Page, "program", Answer),
          Answer.type == "done",
          Answer.text == Text,
          atom_string(File, Answer.file),
          Answer.files == [Answer.file],
          Answer.older == false,
          query(Top, "start."),
          % It may be looked at between two waits.
          frame_with(Page, Frame, ( get_dict(active, Frame, [Inner, Outer]),
                                    _{line: 11, goal: "wait"} :< Inner,
                                    _{line: 5, goal: "wait_a_little"} :< Outer ), 200),
          page_ask(Page, "stop", _),
          frame_with(Page, Last, ( ended(Last), Last.active == [] ), 2000),
          query(Top, "writeln(alive)."),
          printed(Top, "alive") )).
test(the_rule_that_is_active) :-
    Text = ":- use_module(library(ev3dev/rules)).\n\nnear :: us_dist_cm(_, D), D < 5 ~> turn(30).\nwander ::\n    true ~>\n    go(10).\nstart :- behave([near, wander]), true.\n",
    with_program(Top, Text, _,
        ( Top = top(_, _, Page),
          done(Page, "program"),
          query(Top, "start."),
          frame_with(Page, Frame, ( get_dict(active, Frame, [Rule|_]), get_dict(rule, Rule, true) ), 200),
          Rule.line =:= 4,
          once(( member(Mark, Frame.active), Mark.line =:= 7, Mark.goal == "behave" )),
          page_ask(Page, "stop", _),
          frame_with(Page, Last, ended(Last), 2000) )).
test(nobody_asks_the_program_unless_a_page_shows_it,
     condition(predicate_property(system:wrap_predicate(_, _, _, _), defined))) :-
    square(Text),
    with_program(Top, Text, _,
        ( Top = top(_, _, Page),
          query(Top, "wrap_predicate(ev3dev_view_source:look, count, W, (flag(looks, N, N+1), W))."),
          query(Top, "start."),
          frame_with(Page, Frame, Frame.program.state == "running", 2000),
          forall(between(1, 30, _), page_ask(Page, "next", _)),
          done(Page, "program"),
          frame_with(Page, Seen, get_dict(active, Seen, [_|_]), 200),
          done(Page, "program off"),
          frame_with(Page, Off, Off.active == [], 500),
          page_ask(Page, "stop", _),
          frame_with(Page, Last, ended(Last), 2000),
          query(Top, "flag(looks, N, N), ( N > 0, N < 10 -> writeln(few) ; writeln(many(N)) )."),
          printed(Top, "few") )).
test(a_file_that_is_loaded_again_is_read_again) :-
    square(Text),
    with_program(Top, Text, File,
        ( Top = top(_, _, Page),
          done(Page, "program"),
          frame_with(Page, First, get_dict(loaded, First, Hash), 200),
          string_concat(Text, "more.\n", More),
          setup_call_cleanup(open(File, write, Out), write(Out, More), close(Out)),
          get_time(Now),
          Later is Now + 3,
          set_time_file(File, _, [modified(Later)]),
          query(Top, "make, writeln(made)."),
          printed(Top, "made"),
          frame_with(Page, Last, Last.loaded =\= Hash, 200),
          page_ask(Page, "program", Answer),
          Answer.text == More,
          Answer.older == false )).
test(a_file_that_was_changed_is_newer_than_what_runs) :-
    square(Text),
    with_program(Top, Text, File,
        ( Top = top(_, _, Page),
          get_time(Now),
          Later is Now + 100,
          set_time_file(File, _, [modified(Later)]),
          page_ask(Page, "program", Answer),
          Answer.older == true,
          delete_file(File),
          refused(Page, "program", "not there any more") )).
:- end_tests(view_source).

:- begin_tests(view_worlds).
test(a_reset_begins_the_world_again) :-
    in_room(Top, Frame,
        ( Top = top(_, _, Page),
          once(( member(Box, Frame.world.items), Box.kind == "box" )),
          format(string(Move), "move ~w 60 220", [Box.id]),
          done(Page, Move),
          query(Top, "sim_add(circle(20, 200, 5)), go_cm(30, 20), writeln(gone)."),
          printed(Top, "gone"),
          frame_with(Page, Gone, ( ended(Gone), Gone.clock.time > 0.5 ), 2000),
          done(Page, "reset"),
          frame(Page, Gone.have, Again),
          Again.new == true,
          Again.clock.time =:= 0,
          Again.name == "room",
          Again.robot.true == Frame.robot.true,
          Again.world.items =@= Frame.world.items,
          query(Top, "go_cm(30, 10), writeln(again)."),
          printed(Top, "again"),
          frame_with(Page, Last, Last.robot.believed \== null, 2000),
          Last.robot.true = [X0, Y0, _],
          Last.robot.believed.pose = [X, Y, _],
          near(X, X0, 1), near(Y, Y0, 1) )).
test(a_reset_keeps_the_pace, true(Pace == "x2")) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          done(Page, "pace x2"),
          done(Page, "reset"),
          frame_with(Page, Frame, Frame.clock.time =:= 0, 2000),
          Pace = Frame.clock.pace )).
test(the_world_as_facts) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          page_ask(Page, "facts", Answer),
          sub_string(Answer.text, 0, _, _, "bounds(0, 0, 300, 250).\n") )).
test(a_reset_stops_the_program) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          query(Top, "repeat, catch((go(20), wait(0.1)), _, true), fail."),
          frame_with(Page, Frame, frame_runs(Frame), 2000),
          done(Page, "reset"),
          frame_with(Page, Last, ended(Last), 2000),
          Last.clock.time =:= 0,
          \+ frame_runs(Last),
          query(Top, "writeln(alive)."),
          printed(Top, "alive") )).
test(after_a_reset_chance_is_as_before, true(First == Second)) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          query(Top, "X is random(1000000), writeln(drawn(X))."),
          printed(Top, "drawn", First),
          frame_with(Page, Frame, ended(Frame), 2000),
          done(Page, "reset"),
          query(Top, "X is random(1000000), writeln(drawn(X))."),
          printed(Top, "drawn", Second) )).
test(a_world_that_is_gone_is_not_begun_again) :-
    tmp_file(world, Base),
    atom_concat(Base, '.pl', File),
    setup_call_cleanup(
        ( open(File, write, Out), format(Out, "start(5, 6, 7).~n", []), close(Out) ),
        in_room(Top, _,
            ( Top = top(_, _, Page),
              format(string(Start), "sim_start(~q, [clock(virtual)]).", [File]),
              query(Top, Start),
              frame_with(Page, Frame, ( Frame.robot.true == [5, 6, 7], ended(Frame) ), 2000),
              delete_file(File),
              refused(Page, "reset", "there is no world"),
              page_ask(Page, "next", Last),
              Last.robot.true == [5, 6, 7] )),
        catch(delete_file(File), _, true)).
test(without_a_simulation_nothing_is_begun_again) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          query(Top, "sim_stop, writeln(over)."),
          printed(Top, "over"),
          refused(Page, "reset", "No simulation runs.") )).

test(a_world_and_a_robot_are_chosen) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          page_ask(Page, "worlds", Choices),
          once(( member(World, Choices.worlds), World.name == "maze", World.from == "pack" )),
          once(( member(Robot, Choices.robots), Robot.name == "touch" )),
          Choices.robot == "default",
          done(Page, "choose world pack maze"),
          frame_with(Page, Maze, Maze.name == "maze", 500),
          Maze.clock.kind == "virtual",
          done(Page, "choose robot pack touch"),
          page_ask(Page, "next", Frame),
          Frame.name == "maze",
          last(Frame.ports, Bumper),
          Bumper.driver == "lego-ev3-touch",
          page_ask(Page, "worlds", After),
          After.robot == "touch",
          refused(Page, "choose world pack moon", "There is no world moon."),
          refused(Page, "choose world file ../room", "There is no world ../room."),
          page_ask(Page, "next", Last),
          film(Frame, Film),
          film(Last, Film) )).
test(files_beside_the_program_are_chosen_and_written) :-
    in_folder(Folder,
        ( file_with(Folder, 'mine.pl', "bounds(0, 0, 90, 90).\nstart(45, 45, 0).\n"),
          file_with(Folder, 'small.pl', "hull(circle(3)).\nmotor(outA, 'lego-ev3-m-motor').\n"),
          file_with(Folder, 'program.pl', "start :- true.\n"),
          in_room(Top, _,
            ( Top = top(_, _, Page),
              format(string(Load), "consult(~q), writeln(loaded).", ['program.pl']),
              format(string(Go), "working_directory(_, ~q).", [Folder]),
              query(Top, Go),
              query(Top, Load),
              printed(Top, "loaded"),
              query(Top, "working_directory(_, '/'), writeln(there)."),
              printed(Top, "there"),
              page_ask(Page, "worlds", Choices),
              findall(Name, ( member(World, Choices.worlds), World.from == "file",
                              Name = World.name ), Names),
              Names == ["mine.pl"],
              findall(Name, ( member(Robot, Choices.robots), Robot.from == "file",
                              Name = Robot.name ), Robots),
              Robots == ["small.pl"],
              done(Page, "choose world file mine.pl"),
              frame_with(Page, Frame, Frame.world.bounds == [0, 0, 90, 90], 500),
              done(Page, "choose robot file small.pl"),
              done(Page, "write own floor(red).\nstart(1, 2, 3).\n"),
              file_text(Folder, 'own.pl', "floor(red).\nstart(1, 2, 3).\n"),
              page_ask(Page, "write own floor(blue).", Again),
              Again.type == "refused", Again.exists == true,
              file_text(Folder, 'own.pl', "floor(red).\nstart(1, 2, 3).\n"),
              done(Page, "rewrite own floor(blue)."),
              file_text(Folder, 'own.pl', "floor(blue)."),
              refused(Page, "rewrite program floor(blue).", "program.pl is no world"),
              refused(Page, "rewrite own go(1).", "go"),
              refused(Page, "rewrite own :- halt.", ""),
              file_text(Folder, 'own.pl', "floor(blue)."),
              directory_files(Folder, Files0),
              msort(Files0, Files),
              Files == ['.', '..', 'mine.pl', 'own.pl', 'program.pl', 'small.pl'] )) )).
test(pages_of_other_computers_write_nothing) :-
    in_folder(Folder,
        in_room(Top, _,
            ( Top = top(_, _, Page),
              format(string(Go), "ev3dev_view_worlds:worlds_settings(any), \c
                                  working_directory(_, ~q), writeln(there).", [Folder]),
              query(Top, Go),
              printed(Top, "there"),
              refused(Page, "write own floor(red).", "Only pages of this"),
              directory_files(Folder, Files),
              length(Files, 2) ))).
% What a world cannot be, and what is said of it; nothing changes then.
impossible("bounds(0, 0, 100, 100).\nstart(50, 50, 0).\nbox(50, 50, 10, 10).", "robot at 50, 50 is inside box(50,").
impossible("bounds(0, 0, 100, 100).\nstart(2, 50, 0).", "").
impossible("bounds(0, 0, 0, 100).", "").
impossible("wall(1, 2, 1, 2).", "").
impossible("circle(1, 2, -3).", "").
impossible("patch(red, [1-2, 3-4]).", "").
impossible("lamp(1, 2, -1).", "").
impossible("box(1, 2).", "").
impossible("go(30).", "go").
impossible("floor(pink).", "pink").
impossible("box(1, 2, 3", "yntax").
impossible(":- halt.", "").

test(a_world_that_cannot_be_is_refused, [forall(impossible(Text, Part))]) :-
    in_room(Top, First,
        ( Top = top(_, _, Page),
          string_concat("check ", Text, Check),
          string_concat("begin x ", Text, Begin),
          refused(Page, Check, Part),
          refused(Page, Begin, Part),
          page_ask(Page, Check, Answer),
          split_string(Text, "\n", "", Lines),
          length(Lines, Count),
          between(1, Count, Answer.line),
          frame(Page, First.have, Frame),
          \+ get_dict(new, Frame, _),
          Frame.program.latched == false )).
test(a_world_begins_from_its_text) :-
    in_room(Top, _,
        ( Top = top(_, _, Page),
          Facts = "bounds(0, 0, 100, 80).\nfloor(green).\nambient(7).\nstart(50, 40, 90).\nbox(10, 10, 5, 5).\n",
          string_concat("check ", Facts, Check),
          done(Page, Check),
          string_concat("begin mine ", Facts, Begin),
          done(Page, Begin),
          frame_with(Page, Frame, Frame.name == "mine", 500),
          Frame.world.bounds == [0, 0, 100, 80],
          Frame.world.start == [50, 40, 90],
          Frame.world.ambient == 7,
          Frame.robot.true == [50, 40, 90],
          done(Page, "place 70 40 0"),
          done(Page, "reset"),
          page_ask(Page, "next", Last),
          Last.name == "mine",
          Last.robot.true == [50, 40, 90] )).
:- end_tests(view_worlds).

:- begin_tests(view_brick).
% A tree of files stands in for a brick: truth, world and hands are not there.

of_a_brick(plain).
of_a_brick(mount).

test(a_motor_and_a_sensor, [forall(( tree(Tree), of_a_brick(Tree) ))]) :-
    token(Token),
    with_tree(Tree,
        ( ( Tree == plain -> put_attribute(in1, value0, 123) ; true ),
          motor_run(outB, 30),
          viewed(Port,
                 ( page_open(Port, Token, Page),
                   frame_with(Page, Frame, motor_shows(Frame)),
                   page_ask(Page, "place 1 2 3", Refused),
                   page_close(Page) )),
          stop_all_motors )),
    Frame.source == "brick",
    Frame.robot.true == null,
    Refused.type == "refused",
    port_of(Frame, "in1", Sensor),
    Sensor.kind == "sensor",
    Sensor.values = [_].

test(the_keys_and_the_screen,
     [ forall(( tree(Tree), of_a_brick(Tree) )),
       true(Keys-Empty-Drawn == ["enter"]-"AAA"-"wAA")
     ]) :-
    token(Token),
    on_dev(Tree,
        viewed(Port,
               ( page_open(Port, Token, Page),
                 screen_clear, screen_show,
                 page_ask(Page, "next", First),
                 press(Tree, enter),
                 screen_point(0, 0), screen_point(1, 0), screen_show,
                 frame_with(Page, Frame, Frame.brick.keys \== []),
                 frame_with(Page, Last, get_dict(screen, Last, _)),
                 page_close(Page) ))),
    Keys = Frame.brick.keys,
    sub_string(First.screen.bits, 0, 3, _, Empty),
    sub_string(Last.screen.bits, 0, 3, _, Drawn).

motor_shows(Frame) :-
    port_of(Frame, "outB", Motor),
    Motor.kind == "motor",
    number(Motor.position).

port_of(Frame, Name, Port) :-
    member(Port, Frame.ports),
    Port.port == Name,
    !.

test(looking_switches_no_mode,
     [forall(( tree(Tree), of_a_brick(Tree) )), true(Mode == Mode0)]) :-
    token(Token),
    with_tree(Tree,
        ( get_attribute(in2, mode, Mode0),
          viewed(Port,
                 ( page_open(Port, Token, Page),
                   forall(between(1, 5, _), page_ask(Page, "next", _)),
                   page_close(Page) )),
          get_attribute(in2, mode, Mode) )).
test(a_motor_is_stopped,
     [forall(( tree(Tree), of_a_brick(Tree) ))]) :-
    with_tree(Tree,
        ( motor_run(outB, 30),
          ev3dev_native:view_latch_,
          ev3dev_native:view_stop_motors_,
          catch(motor_run(outB, 30), Error, true),
          ev3dev_native:view_lift_,
          stops(outB) )),
    Error = error(permission_error(start, motor, outB), _).
:- end_tests(view_brick).
