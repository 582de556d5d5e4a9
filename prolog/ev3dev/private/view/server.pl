:- module(ev3dev_view_server,
          [ server_start/3,             % +Address, ?Port, +Token
            server_stop/1               % +Port
          ]).
:- use_module(library(lists), [append/3, member/2, subtract/3]).
:- use_module(library(http/thread_httpd),
              [ http_server/2, http_server_property/2, http_spawn/2,
                http_stop_server/2
              ]).
:- use_module(library(socket),
              [tcp_close_socket/1, tcp_connect/2, tcp_socket/1]).
:- use_module(library(http/http_stream), []).
:- use_module('../native',
              [ view_csv_/1, view_hang_up_/1, view_keep_sockets_/1,
                view_world_/1 ]).
:- use_module(page, [page_serve/2, pages/1]).
:- use_module(program, [stop_program/0, view_thread/0]).
:- use_module(socket, [accept_key/2]).

/** <module> The server of the view

A server of its own with a fixed table: what a program of the user serves
elsewhere has nothing to do with it. Before anything is looked up, a request
must come from a page of ours: `Host`, `Origin`, then the token or the cookie,
then the method.
*/

:- dynamic
    served/3,                           % Port, Address, Token
    served_file/3,                      % Path, Type, File
    files_directory/1.

%   The most pages at once.
most_pages(16).

%!  server_start(+Address, ?Port, +Token) is det.
%
%   Serve pages at a port of localhost, or of any address.

server_start(Address, Port, Token) :-
    find_files,
    bound(Address, Port, Where),
    findall(Thread, thread_property(Thread, status(_)), Before),
    setup_call_cleanup(
        asserta((user:message_hook(httpd_started_server(_), _, _) :- true),
                Hook1),
        setup_call_cleanup(
            asserta((user:message_hook(httpd_started_server(_, _), _, _) :-
                         true),
                    Hook2),
            ( stack_options(Stacks),
              http_server(ev3dev_view_server:request,
                          [ port(Where),
                            workers(6),
                            timeout(5),
                            keep_alive_timeout(1)
                          | Stacks
                          ]) ),
            erase(Hook2)),
        erase(Hook1)),
    findall(Thread, thread_property(Thread, status(_)), After),
    subtract(After, Before, New),
    forall(member(Thread, New),
           pass_over(Thread)),
    view_keep_sockets_(Port),
    retractall(served(_, _, _)),
    assertz(served(Port, Address, Token)).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

%   library(http) reads a line of any length: what does not fit into these
%   stacks ends the request. Before version 8 there is one for each purpose,
%   in kilobytes.
stack_options(Options) :-
    (   current_prolog_flag(version, Version),
        Version >= 80000
    ->  Options = [stack_limit(16000000)]
    ;   Options = [global(8000), local(4000), trail(4000)]
    ).

bound(localhost, Port, localhost:Port).
bound(any, Port, Port).

%   A thread of the server says itself that it is no part of the program.
pass_over(Thread) :-
    catch(thread_signal(Thread, ev3dev_view_server:view_thread_once),
          error(_, _), true).

%!  server_stop(+Port) is det.
%
%   End the server. The pages have been closed before.

server_stop(Port) :-
    retractall(served(_, _, _)),
    % A browser keeps connections open, and a worker waits for each.
    view_hang_up_(Port),
    (   http_server_property(Port, start_time(_))
    ->  Name = Port
    ;   Name = localhost:Port
    ),
    stop_named(Name, Port),
    % Those that came meanwhile would wait for ever.
    view_hang_up_(Port).

%   The thread that accepts connections ends by an exception. If that comes
%   while it looks for workers, library(http) takes it for a fault of those
%   who offer them, prints it, and goes on: so it is told again. Before
%   version 8 nothing wakes it, either. While Prolog halts, version 10
%   creates no thread.
stop_named(Name, Port) :-
    setup_call_cleanup(
        ( retractall(told(_, _)),
          asserta((user:message_hook(Message, error, _) :-
                       ev3dev_view_server:passed_over(Message)),
                  Hook),
          waker(Port, Wakers) ),
        catch(ignore(http_stop_server(Name, [])), error(_, _), true),
        ( forall(member(Waker, Wakers),
                 ( thread_send_message(Waker, stopped),
                   thread_join(Waker, _) )),
          erase(Hook) )).

waker(Port, [Waker]) :-
    catch(thread_create(wake(Port), Waker, []),
          error(permission_error(_, _, _), _), fail),
    !.
waker(_, []).

:- dynamic told/2.                      % Thread, Stop

passed_over(Stop) :-
    ( Stop = http_stop ; Stop = http_stop(_) ),
    !,
    thread_self(Me),
    assertz(told(Me, Stop)).

wake(Port) :-
    forall(retract(told(Thread, Stop)),
           catch(thread_signal(Thread, throw(Stop)), error(_, _), true)),
    catch(setup_call_cleanup(
              tcp_socket(Socket),
              tcp_connect(Socket, localhost:Port),
              tcp_close_socket(Socket)),
          error(_, _), true),
    thread_self(Me),
    (   thread_get_message(Me, stopped, [timeout(0.02)])
    ->  true
    ;   wake(Port)
    ).

:- prolog_load_context(directory, Here),
   atom_concat(Here, '/../../view', Directory),
   assertz(files_directory(Directory)).

find_files :-
    files_directory(Directory),
    retractall(served_file(_, _, _)),
    catch(directory_files(Directory, Files), _, Files = []),
    forall(( member(File, Files),
             file_name_extension(Base, Extension, File),
             Base \== '',
             type(Extension, Type) ),
           ( atomic_list_concat([Directory, /, File], Path),
             atom_concat(/, File, Location),
             assertz(served_file(Location, Type, Path)) )).

type(html, 'text/html; charset=utf-8').
type(css, 'text/css; charset=utf-8').
type(js, 'text/javascript; charset=utf-8').
type(svg, 'image/svg+xml').
type(png, 'image/png').
type(woff2, 'font/woff2').

%   What library(http) says by itself of a request that it cannot read tells
%   the other side nothing, either. (Before version 9 there is no such hook.)
:- multifile http:status_page/3.
:- dynamic http:status_page/3.

http:status_page(Status, _, ['Not possible.\n']) :-
    integer(Status),
    ev3dev_view_server:serves_here.

serves_here :-
    served(Port, _, _),
    thread_self(Me),
    catch(thread_property(Me, alias(Alias)), _, fail),
    format(atom(Ours), ':~w_', [Port]),
    sub_atom(Alias, _, _, _, Ours),
    !.

%!  request(+Request) is det.
%
%   Answer a request of library(http). Tells the other side nothing of an
%   error.

request(Request) :-
    catch(view_thread_once, _, true),
    (   served(Port, Address, Token)
    ->  view_keep_sockets_(Port),
        answer(Request, Port, Address, Token)
    ;   % No worker would read what follows on this connection.
        refuse(503, 'Service Unavailable', 'The view has ended.',
               ['Connection'-close])
    ).

:- thread_local known/0.

view_thread_once :-
    (   known
    ->  true
    ;   assertz(known),
        view_thread
    ).

answer(Request, Port, Address, Token) :-
    \+ host_is_ours(Request, Port, Address),
    !,
    ignore(Token = Token),
    refuse(403, 'Forbidden', 'This name is not the one of this server.').
answer(Request, _, _, _) :-
    \+ origin_is_ours(Request),
    !,
    refuse(403, 'Forbidden', 'This request comes from another page.').
answer(Request, Port, _, Token) :-
    \+ may_enter(Request, Port, Token),
    !,
    refuse(403, 'Forbidden',
           'Start from the address that view/0 has printed.').
answer(Request, Port, _, Token) :-
    memberchk(path(Path), Request),
    memberchk(method(Method), Request),
    (   \+ served_at(Path, _, _)
    ->  refuse(404, 'Not Found', 'There is no such page.')
    ;   served_at(Path, Method, Goal)
    ->  reply(Goal, Request, Port, Token)
    ;   refuse(405, 'Method Not Allowed', 'Not this way.')
    ).

%   The table.
served_at(/, get, page).
served_at('/ws', get, upgrade).
served_at('/world.pl', get, world).
served_at('/samples.csv', get, samples).
served_at('/stop', post, stop).
served_at(Path, get, file(Type, File)) :-
    served_file(Path, Type, File).

%   All names that a request has for this server must be ours.
host_is_ours(Request, Port, Address) :-
    memberchk(host(_), Request),
    \+ ( member(host(Host), Request),
         \+ host_name(Host, Address) ),
    (   memberchk(port(Port1), Request)
    ->  Port1 =:= Port
    ;   Port =:= 80
    ).

host_name(Host0, Address) :-
    downcase_atom(Host0, Host),
    (   memberchk(Host, [localhost, '127.0.0.1', '[::1]'])
    ->  true
    ;   Address == any,
        ( numeric(Host) ; machine_name(Host) )
    ->  true
    ).

numeric(Host) :-
    atomic_list_concat(Parts, '.', Host),
    length(Parts, 4),
    \+ ( member(Part, Parts),
         \+ ( catch(atom_number(Part, Number), _, fail),
              integer(Number),
              between(0, 255, Number) ) ).

machine_name(Host) :-
    catch(setup_call_cleanup(
              open('/proc/sys/kernel/hostname', read, In),
              read_term_from_line(In, Name),
              close(In)),
          _, fail),
    (   Host == Name
    ->  true
    ;   atom_concat(Name, '.local', Host)
    ).

read_term_from_line(In, Name) :-
    read_codes(In, Codes),
    atom_codes(Name0, Codes),
    downcase_atom(Name0, Name).

read_codes(In, Codes) :-
    get_code(In, Code),
    (   Code > 0'\s
    ->  Codes = [Code|Codes1],
        read_codes(In, Codes1)
    ;   Codes = []
    ).

%   A page of another server has another origin. Only a request that changes
%   nothing may come without one.
origin_is_ours(Request) :-
    memberchk(host(Host), Request),
    (   memberchk(port(Port), Request)
    ->  format(atom(Ours), 'http://~w:~w', [Host, Port])
    ;   format(atom(Ours), 'http://~w', [Host])
    ),
    findall(Origin, member(origin(Origin), Request), Origins),
    (   Origins = []
    ->  memberchk(method(Method), Request),
        memberchk(Method, [get, head]),
        \+ memberchk(path('/ws'), Request)
    ;   \+ ( member(Origin, Origins),
             Origin \== Ours )
    ).

may_enter(Request, _, Token) :-
    memberchk(path(/), Request),
    memberchk(search(Search), Request),
    memberchk(t=Given, Search),
    !,
    same(Given, Token).
may_enter(Request, Port, Token) :-
    atom_concat(ev3view_, Port, Name),
    member(cookie(Cookies), Request),
    member(Name=Given, Cookies),
    same(Given, Token),
    !.

%   Takes as long for any text of that length.
same(Given, Token) :-
    atom_codes(Given, Codes1),
    atom_codes(Token, Codes2),
    differences(Codes1, Codes2, 0, Differences),
    Differences =:= 0.

differences([], [], Differences, Differences).
differences([Code1|Codes1], [Code2|Codes2], Differences0, Differences) :-
    Differences1 is Differences0 \/ (Code1 xor Code2),
    differences(Codes1, Codes2, Differences1, Differences).

refuse(Code, Word, Why) :-
    refuse(Code, Word, Why, []).

refuse(Code, Word, Why, More) :-
    head(Code, Word, 'text/plain; charset=utf-8', More),
    format('~w~n', [Why]).

reply(page, Request, Port, Token) :-
    (   served_file('/index.html', Type, File)
    ->  format(atom(Cookie),
               'ev3view_~w=~w; HttpOnly; SameSite=Strict; Path=/',
               [Port, Token]),
        head(200, 'OK', Type, ['Set-Cookie'-Cookie], Request),
        copy_file(File)
    ;   refuse(404, 'Not Found', 'The page is not installed.')
    ).
reply(file(Type, File), Request, _, _) :-
    head(200, 'OK', Type, [], Request),
    copy_file(File).
reply(world, Request, _, _) :-
    (   view_world_(Text)
    ->  head(200, 'OK', 'text/plain; charset=utf-8',
             ['Content-Disposition'-'attachment; filename="world.pl"'],
             Request),
        write(Text)
    ;   refuse(404, 'Not Found', 'No simulation runs.')
    ).
reply(samples, Request, _, _) :-
    (   view_csv_(Text)
    ->  head(200, 'OK', 'text/csv; charset=utf-8',
             ['Content-Disposition'-'attachment; filename="samples.csv"'],
             Request),
        write(Text)
    ;   refuse(404, 'Not Found', 'There are no samples.')
    ).
reply(stop, Request, _, _) :-
    stop_program,
    head(200, 'OK', 'text/plain; charset=utf-8', [], Request),
    format('stopped~n').
reply(upgrade, Request, _, _) :-
    (   handshake(Request, Key)
    ->  pages(Pages),
        length(Pages, Count),
        most_pages(Most),
        (   Count < Most
        ->  accept_key(Key, Accept),
            http_spawn(ev3dev_view_server:switch(Accept), [])
        ;   refuse(503, 'Service Unavailable', 'There are enough pages.')
        )
    ;   refuse(400, 'Bad Request', 'This is for a websocket.')
    ).

handshake(Request, Key) :-
    memberchk(upgrade(Upgrade), Request),
    downcase_atom(Upgrade, websocket),
    memberchk(sec_websocket_version(Version), Request),
    version(Version),
    memberchk(sec_websocket_key(Key), Request),
    atom_length(Key, 24).

version(13).
version('13').

%   The answer 101, and then this connection is no HTTP any more.
switch(Accept) :-
    throw(http_reply(switching_protocols(
                         ev3dev_view_page:page_serve,
                         [ header([ upgrade(websocket),
                                    connection('Upgrade'),
                                    sec_websocket_accept(Accept)
                                  ])
                         ]))).

head(Code, Word, Type, More) :-
    head(Code, Word, Type, More, []).

%   Nothing that a page loads or sends may be elsewhere.
head(Code, Word, Type, More, Request) :-
    sockets(Request, Sockets),
    format(atom(Policy),
           'default-src \'self\'; connect-src \'self\'~w; \c
            img-src \'self\' blob:; base-uri \'none\'; \c
            form-action \'none\'; frame-ancestors \'none\'',
           [Sockets]),
    append([ 'Content-Security-Policy'-Policy,
             'X-Content-Type-Options'-nosniff,
             'Referrer-Policy'-'no-referrer',
             'Cache-Control'-'no-store'
           ], More, Fields),
    format('Status: ~w ~w~n', [Code, Word]),
    forall(member(Name-Value, Fields),
           format('~w: ~w~n', [Name, Value])),
    format('Content-type: ~w~n~n', [Type]).

sockets(Request, Sockets) :-
    memberchk(host(Host), Request),
    memberchk(port(Port), Request),
    !,
    format(atom(Sockets), ' ws://~w:~w', [Host, Port]).
sockets(_, '').

copy_file(File) :-
    setup_call_cleanup(
        open(File, read, In, [type(binary)]),
        ( set_stream(current_output, encoding(octet)),
          copy_stream_data(In, current_output) ),
        close(In)).
