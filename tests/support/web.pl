:- module(web,
          [ request/4,                  % +Port, +Lines, -Code, -Answer
            get/5,                      % +Port, +Path, +Fields, -Code, -Answer
            cookie/3,                   % +Port, +Token, -Field
            page_open/3,                % +Port, +Token, -Page
            page_open/5,                % +Port, +Path, +Fields, -Code, -Page
            page_say/2,                 % +Page, +Line
            page_hear/2,                % +Page, -Answer
            page_ask/3,                 % +Page, +Line, -Answer
            page_bytes/2,               % +Page, +Bytes
            page_close/1,               % +Page
            besieged/4                  % +Port, +Count, +Kind, :Goal
          ]).
:- use_module(old_prolog).
:- use_module(library(apply)).
:- use_module(library(http/json)).
:- use_module(library(lists)).
:- use_module(library(readutil)).
:- use_module(library(socket)).

/** <module> A browser's side of the view, as small as can be
*/

connect(Port, In, Out) :-
    tcp_socket(Socket),
    tcp_connect(Socket, localhost:Port),
    tcp_open_socket(Socket, In, Out),
    set_stream(In, timeout(300)),
    maplist([S]>>( set_stream(S, encoding(octet)),
                   set_stream(S, newline(posix)) ), [In, Out]).

%!  request(+Port, +Lines, -Code, -Answer)
%
%   Send these lines and an empty one; Code is that of the answer, Answer all of
%   it. Code is `none` if there was none.

request(Port, Lines, Code, Answer) :-
    setup_call_cleanup(
        connect(Port, In, Out),
        ( send_lines(Out, Lines),
          catch(read_stream_to_codes(In, Codes), _, Codes = []) ),
        ( close(In, [force(true)]), close(Out, [force(true)]) )),
    string_codes(Answer, Codes),
    code(Answer, Code).

send_lines(Out, Lines) :-
    catch(( forall(member(Line, Lines),
                   format(Out, "~w\r\n", [Line])),
            format(Out, "\r\n", []),
            flush_output(Out) ),
          error(_, _), true).

code(Answer, Code) :-
    (   split_string(Answer, " ", "", [_, Code0|_]),
        catch(number_string(Code, Code0), _, fail)
    ->  true
    ;   Code = none
    ).

%!  get(+Port, +Path, +Fields, -Code, -Answer)

get(Port, Path, Fields, Code, Answer) :-
    format(string(First), "GET ~w HTTP/1.1", [Path]),
    host(Port, Fields, Host),
    append([First|Host], ["Connection: close"|Fields], Lines),
    request(Port, Lines, Code, Answer).

%   Fields may have a Host of their own.
host(Port, Fields, Host) :-
    (   member(Field, Fields),
        sub_string(Field, 0, _, _, "Host:")
    ->  Host = []
    ;   format(string(Line), "Host: localhost:~w", [Port]),
        Host = [Line]
    ).

cookie(Port, Token, Field) :-
    format(string(Field), "Cookie: ev3view_~w=~w", [Port, Token]).

%!  page_open(+Port, +Token, -Page) is det.
%!  page_open(+Port, +Path, +Fields, -Code, -Page) is det.
%
%   Open a websocket; Page is page(In, Out), or `none` if that was refused.

page_open(Port, Token, Page) :-
    cookie(Port, Token, Cookie),
    format(string(Origin), "Origin: http://localhost:~w", [Port]),
    page_open(Port, '/ws', [Cookie, Origin], 101, Page).

page_open(Port, Path, Fields, Code, Page) :-
    connect(Port, In, Out),
    format(string(First), "GET ~w HTTP/1.1", [Path]),
    host(Port, Fields, Host),
    append([ [First|Host], Fields,
             [ "Upgrade: websocket", "Connection: Upgrade",
               "Sec-WebSocket-Version: 13",
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==" ] ], Lines),
    send_lines(Out, Lines),
    read_head(In, Head),
    code(Head, Code),
    (   Code == 101
    ->  Page = page(In, Out)
    ;   close(In, [force(true)]),
        close(Out, [force(true)]),
        Page = none
    ).

read_head(In, Head) :-
    read_line_to_string(In, Line),
    (   memberchk(Line, ["\r", "", end_of_file])
    ->  Head = ""
    ;   Line == -1
    ->  Head = ""
    ;   read_head(In, Rest),
        string_concat(Line, Rest, Head)
    ).

%!  page_say(+Page, +Line)
%
%   Send a line. Its letters are ASCII.

page_say(Page, Line) :-
    string_codes(Line, Codes),
    length(Codes, Length),
    (   Length < 126
    ->  Second is 128 + Length,
        Head = [0x81, Second]
    ;   High is Length >> 8,
        Low is Length /\ 255,
        Head = [0x81, 254, High, Low]
    ),
    append([Head, [0, 0, 0, 0], Codes], Bytes),
    page_bytes(Page, Bytes).

page_bytes(page(_, Out), Bytes) :-
    forall(member(Byte, Bytes), put_code(Out, Byte)),
    flush_output(Out).

%!  page_hear(+Page, -Answer)
%
%   Answer is a dict, or close(Code), ping, pong, or end.

page_hear(page(In, _), Answer) :-
    get_code(In, First),
    (   First == -1
    ->  Answer = end
    ;   get_code(In, Length0),
        length_of(Length0, In, Length),
        length(Codes, Length),
        maplist(get_code(In), Codes),
        OpCode is First /\ 15,
        heard(OpCode, Codes, Answer)
    ).

length_of(126, In, Length) :-
    !,
    get_code(In, High),
    get_code(In, Low),
    Length is High << 8 + Low.
length_of(127, In, Length) :-
    !,
    length(Codes, 8),
    maplist(get_code(In), Codes),
    foldl([Code, L0, L]>>(L is L0 << 8 + Code), Codes, 0, Length).
length_of(Length, _, Length).

heard(1, Codes, Answer) :-
    atom_codes(Text, Codes),
    atom_json_dict(Text, Answer, []).
heard(8, [High, Low|_], close(Code)) :-
    Code is High << 8 + Low.
heard(9, _, ping).
heard(10, _, pong).

%   A slow machine is asked by a ping whether it is still there.

page_ask(Page, Line, Answer) :-
    page_say(Page, Line),
    page_hear(Page, Heard),
    (   Heard == ping
    ->  page_hear(Page, Answer)
    ;   Answer = Heard
    ).

page_close(page(In, Out)) :-
    close(In, [force(true)]),
    close(Out, [force(true)]).

%!  besieged(+Port, +Count, +Kind, :Goal)
%
%   Call Goal while n strangers are connected. Kind is what they do.

:- meta_predicate besieged(+, +, +, 0).

besieged(Port, Count, Kind, Goal) :-
    stranger(Kind, First, More),
    atomic_list_concat(Parts, '~w', First),
    atomic_list_concat(Parts, Port, Sent),
    setup_call_cleanup(
        findall(In-Out, ( between(1, Count, _),
                          connect(Port, In, Out),
                          send(Out, Sent) ), Strangers),
        setup_call_cleanup(
            thread_create(go_on(Strangers, More), Thread, []),
            once(Goal),
            ( catch(thread_send_message(Thread, enough), error(_, _), true),
              thread_join(Thread, Status),
              must_be(oneof([true]), Status) )),
        forall(member(In-Out, Strangers),
               ( close(In, [force(true)]),
                 close(Out, [force(true)]) ))).

%   What a stranger sends at first, with the port, and then again and again.
stranger(silent, "", "").
stranger(slow, "GET / HTTP/1.1\r\nHost: localhost:~w\r\nX: ", "x").
stranger(endless, "GET / HTTP/1.1\r\nHost: localhost:~w\r\nX: ", More) :-
    length(Codes, 4000),
    maplist(=(0'x), Codes),
    string_codes(More, Codes).
stranger(no_token, "GET / HTTP/1.1\r\nHost: localhost:~w\r\n\r\n", "").
stranger(wrong_token,
         "GET /?t=wrong HTTP/1.1\r\nHost: localhost:~w\r\n\r\n", "").
stranger(websocket,
         "GET /ws HTTP/1.1\r\nHost: localhost:~w\r\n\c
          Origin: http://localhost:~w\r\nUpgrade: websocket\r\n\c
          Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\c
          Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n", "").

go_on(Strangers, More) :-
    forall(( More \== "", member(_-Out, Strangers) ),
           send(Out, More)),
    thread_self(Me),
    (   thread_get_message(Me, enough, [timeout(0.05)])
    ->  true
    ;   go_on(Strangers, More)
    ).

%   A stream that was closed at the other end throws, or just fails.
send(Out, Text) :-
    ignore(catch(( write(Out, Text), flush_output(Out) ), error(_, _), true)).
