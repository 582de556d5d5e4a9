:- module(ev3dev_view_page,
          [ page_serve/2,               % +In, +Out
            pages/1,                    % -Threads
            pages_close/0,
            page_settings/2             % +Rate, +Goals
          ]).
:- use_module('../native', [view_frame_/4, view_json_/2]).
:- use_module(goals, [goal_line/4, goals_end/0]).
:- use_module(hands, [hand_line/3]).
:- use_module(known, [renew_kept/0]).
:- use_module(log, [error_text/2, mark/1]).
:- use_module(program,
              [ lift_latch/0, probe_program/0, program_state/1,
                stop_program/0, view_thread/0
              ]).
:- use_module(socket,
              [close_send/2, message_read/2, message_send/2, ping_send/1]).

/** <module> The conversation with a page

A thread for each page. The page asks for a frame when it has drawn the one
before; so a page that does not draw costs nothing. A frame that is asked for
too early is held back, and what else the page says is done meanwhile.
*/

:- dynamic
    page/1,                             % Thread
    settings/3.                         % Interval, Json, Goals

settings(0.05, "", false).

%   A page that says nothing for so long is asked whether it is still there,
%   and is left when it does not answer for as long again.
silence(30).

%!  page_settings(+Rate, +Goals) is det.
%
%   At most Rate frames in a second for a page; Goals says whether a page may
%   send goals.

page_settings(Rate, Goals) :-
    Interval is 1.0 / Rate,
    format(string(Json), "\"rate\":~w,\"goals\":~w", [Rate, Goals]),
    retractall(settings(_, _, _)),
    assertz(settings(Interval, Json, Goals)).

%!  pages(-Threads) is det.

pages(Threads) :-
    findall(Thread, page(Thread), Threads).

%!  pages_close is det.
%
%   Say good-bye to all pages, and wait until they are closed.

pages_close :-
    with_mutex(ev3dev_view_pages,
               forall(page(Thread),
                      catch(thread_signal(Thread, throw(ev3dev_view(stop))),
                            _, true))),
    wait_closed(200),
    retractall(page(_)).

wait_closed(Left) :-
    (   Left > 0,
        page(Thread),
        catch(thread_property(Thread, status(running)), _, fail)
    ->  sleep(0.01),
        Left1 is Left - 1,
        wait_closed(Left1)
    ;   true
    ).

%!  page_serve(+In, +Out) is det.
%
%   Serve a page at the streams of its connection, until either side ends it.

page_serve(In, Out) :-
    view_thread,
    thread_self(Me),
    %   pages_close/0 may throw when the conversation is over already.
    catch(serve_to_end(Me, In, Out), ev3dev_view(stop),
          end(ev3dev_view(stop), In, Out)).

serve_to_end(Me, In, Out) :-
    catch(setup_call_cleanup(
              assertz(page(Me)),
              conversation(In, Out),
              with_mutex(ev3dev_view_pages, retractall(page(Me)))),
          End, true),
    end(End, In, Out).

end(End, In, Out) :-
    goals_end,
    farewell(End, Out),
    catch(close(In, [force(true)]), _, true),
    catch(close(Out, [force(true)]), _, true).

farewell(End, Out) :-
    (   nonvar(End),
        End = ev3dev_view(stop)
    ->  catch(( message_send(Out, "{\"type\":\"bye\",\"why\":\"stopped\"}"),
                close_send(Out, 1001) ),
              _, true)
    ;   true
    ).

conversation(In, Out) :-
    set_stream(In, encoding(octet)),
    set_stream(In, newline(posix)),
    set_stream(In, timeout(10)),
    set_stream(Out, encoding(octet)),
    set_stream(Out, newline(posix)),
    set_stream(Out, buffer(full)),
    probe_program,
    converse(In, Out, none, 0, 0).

%   Wanted is what the page has that wants a frame, or `none`; Last is when it
%   got the last one. Asked says how often it was asked whether it is there.
converse(In, Out, Wanted, Last, Asked) :-
    time_left(Wanted, Last, Left),
    wait_for_input([In], Ready, Left),
    (   Ready = [_|_]
    ->  message_read(In, Message),
        act(Message, In, Out, Wanted, Last)
    ;   Wanted = wanted(Have)
    ->  frame_send(Out, Have),
        get_time(Now),
        converse(In, Out, none, Now, 0)
    ;   Asked > 0
    ->  true
    ;   ping_send(Out),
        converse(In, Out, none, Last, 1)
    ).

time_left(none, _, Left) :-
    silence(Left).
time_left(wanted(_), Last, Left) :-
    settings(Interval, _, _),
    get_time(Now),
    %   A time of 0 is forever.
    Left is max(0.0005, Last + Interval - Now).

act(close, _, Out, _, _) :-
    catch(close_send(Out, 1000), _, true).
act(fault(Code), _, Out, _, _) :-
    catch(close_send(Out, Code), _, true).
act(ping(Bytes), In, Out, Wanted, Last) :-
    pong_send(Out, Bytes),
    converse(In, Out, Wanted, Last, 0).
act(pong, In, Out, Wanted, Last) :-
    converse(In, Out, Wanted, Last, 0).
act(text(Line), In, Out, Wanted0, Last) :-
    word_rest(Line, Word, Rest),
    (   Word == next
    ->  due(Rest, Last, Out, Wanted, Last1),
        converse(In, Out, Wanted, Last1, 0)
    ;   line(Word, Rest, Out)
    ->  converse(In, Out, Wanted0, Last, 0)
    ;   catch(close_send(Out, 1008), _, true)
    ).

%   A frame that is due is sent at once.
due(Have, Last, Out, Wanted, Last1) :-
    settings(Interval, _, _),
    get_time(Now),
    (   Now >= Last + Interval - 0.0005
    ->  frame_send(Out, Have),
        Wanted = none,
        Last1 = Now
    ;   Wanted = wanted(Have),
        Last1 = Last
    ).

frame_send(Out, Have) :-
    settings(_, Settings, _),
    program_state(State),
    renew_kept,
    view_frame_(Have, State, Settings, Text),
    message_send(Out, Text).

pong_send(Out, Bytes) :-
    length(Bytes, Length),
    format(Out, "~s", [[0x8a, Length|Bytes]]),
    flush_output(Out).

word_rest(Line, Word, Rest) :-
    (   sub_string(Line, Before, 1, After, " ")
    ->  sub_atom(Line, 0, Before, _, Word),
        sub_string(Line, _, After, 0, Rest)
    ;   atom_string(Word, Line),
        Rest = ""
    ).

%   What a page says is one of these; nothing of it is ever called.
line(stop, "", Out) :-
    !,
    stop_program,
    done(Out, stop, []).
line(go, "", Out) :-
    !,
    lift_latch,
    done(Out, go, []).
line(mark, Text0, Out) :-
    !,
    string_length(Text0, Length),
    Length > 0,
    End is min(200, Length),
    sub_string(Text0, 0, End, _, Text),
    mark(Text),
    done(Out, mark, []).
line(Word, Rest, Out) :-
    memberchk(Word, [goal, more, enough]),
    !,
    settings(_, _, Goals),
    (   Goals == true
    ->  goal_line(Word, Rest, Out, Refused),
        (   nonvar(Refused)
        ->  refused(Out, Word, Refused)
        ;   true
        )
    ;   refused(Out, Word, "Goals are not allowed: view([goals(true)]).")
    ).
line(Word, Rest, Out) :-
    hand_line(Word, Rest, Answer),
    (   Answer = done(More)
    ->  done(Out, Word, More)
    ;   Answer = refused(Why)
    ->  refused(Out, Word, Why)
    ;   true
    ).

done(Out, Word, More) :-
    (   More = [id(Id)]
    ->  format(string(Text), "{\"type\":\"done\",\"what\":\"~w\",\"id\":~w}",
               [Word, Id])
    ;   format(string(Text), "{\"type\":\"done\",\"what\":\"~w\"}", [Word])
    ),
    message_send(Out, Text).

refused(Out, Word, Why0) :-
    (   string(Why0)
    ->  Why = Why0
    ;   error_text(Why0, Why)
    ),
    view_json_(Why, Json),
    format(string(Text),
           "{\"type\":\"refused\",\"what\":\"~w\",\"why\":~w}", [Word, Json]),
    message_send(Out, Text).
