:- module(old_samples,
          [ wrong_sample/3              % -Text, -Expected, -Found
          ]).
:- use_module(uses, [text_problem/3]).

/** <module> The lint for 7.2.3 finds what it should, and nothing else

Each sample is the text of a file, with the problems that are in it.
*/

%!  wrong_sample(-Text, -Expected, -Found) is nondet.
%
%   Text has problems that are not found, or others are.

wrong_sample(Text, Expected, Found) :-
    sample(Text, Expected0),
    sort(Expected0, Expected),
    findall(Problem, text_problem(Text, _, Problem), Found0),
    sort(Found0, Found),
    Found \== Expected.

% ---------------- FUNCTIONS

sample("p(X) :- X is inf.", [function-inf/0]).
sample("p(X) :- X =:= 2*nan+1.", [function-nan/0]).
sample("p(X, Y) :- ( X < -inf -> true ; Y >= lcm(X, 3) ).",
       [function-inf/0, function-lcm/2]).
sample("p(L) :- maplist(=<(inf), L), forall(member(X, L), X =\\= cmpflags).",
       [function-inf/0, function-cmpflags/0]).
sample("p(X) :- tab(user_error, trig), Y = inf, X = f(nan), print(Y).",
       [function-trig/0]).
sample("p(X) :- X is max(pi, abs(e)) + \"a\" + [0'b] - cot(1.0).",
       [function-cot/1]).
sample(":- arithmetic_function(twice/1).
        twice(X, Y) :- Y is X*2.
        p(Y) :- Y is twice(3).",
       []).

% ---------------- FLAGS

sample("p(X) :- current_prolog_flag(max_integer, X).", [flag-max_integer]).
sample(":- set_prolog_flag(stack_limit, 1000).", [flag-stack_limit]).
sample(":- create_prolog_flag(tmp_dir, '/tmp', [type(atom)]).",
       [flag-tmp_dir]).
sample(":- create_prolog_flag(ev3dev_new, 1, []), set_prolog_flag(gc, true).
        p :- current_prolog_flag(gc_thread, true).
        q(X) :- current_prolog_flag(ev3dev_new, X).",
       []).

% ---------------- OPTIONS

sample("p(F, S) :- open(F, write, S, [encoding(utf8), newline(posix)]).",
       [option(open/4)-newline]).
sample("p(F, S) :- open(F, read, S, [encoding(utf16le), type(binary)]).",
       [option(open/4)-encoding(utf16le)]).
sample("p(F, S, O) :- open(F, read, S, [bom=true, close_on_exec=true|O]).",
       [option(open/4)-close_on_exec]).
sample("p(S, T) :- read_term(S, T, [var_prefix(true), module(user)]).",
       [option(read_term/3)-var_prefix]).
sample("p(T) :- write_term(T, [quoted(true), no_lists(true)]).",
       [option(write_term/2)-no_lists]).
sample("p(F) :- load_files(F, [if(exist), imports([])]).",
       [option(load_files/2)-if(exist)]).
sample("p(F, G) :- absolute_file_name(F, G, [file_type(regular)]).",
       [option(absolute_file_name/3)-file_type(regular)]).
sample("p(F, T) :- read_file_to_terms(F, T, [encoding(utf8), zork(1)]).",
       [option(read_file_to_terms/3)-zork]).
sample("p(T) :- thread_create(true, T, [stack_limit(1), detached(true)]).",
       [option(thread_create/3)-stack_limit]).
sample("p :- create_prolog_flag(ev3dev_x, 1, [type(oneof([1])), keep(true)]),
             create_prolog_flag(ev3dev_y, 1, [type(string)]).",
       [option(create_prolog_flag/3)-type(string)]).
sample("p(P) :- process_create(path(ls), [], [stdout(null), extra_env([])]),
             close(P, [force(true)]), findall(X, close(X, [now(true)]), _).",
       [option(process_create/3)-extra_env, option(close/2)-now]).

% ---------------- PROPERTIES, KEYS

sample("p(H) :- predicate_property(H, defined).",
       [property(predicate_property/2)-defined]).
sample("p(H) :- ( predicate_property(p:H, size(_)) -> true ; call(H) ).",
       [property(predicate_property/2)-size]).
sample("p(M) :- module_property(M, file(_)),
               module_property(M, last_modified(_)).",
       [property(module_property/2)-last_modified]).
sample("p(S) :- stream_property(S, write_errors(_)),
               stream_property(S, alias(a)).",
       [property(stream_property/2)-write_errors]).
sample("p(S) :- set_stream(S, newline(posix)),
               set_stream(S, encoding('UTF-8')).",
       [property(set_stream/2)-encoding('UTF-8')]).
sample("p(T) :- thread_property(T, status(_)), thread_property(T, id(_)).",
       [property(thread_property/2)-id]).
sample(":- initialization(p, main). p.", [property((initialization)/2)-main]).
sample(":- initialization(p, program). :- initialization(p, now). p.",
       [property((initialization)/2)-program]).
sample(":- use_module(library(ev3dev)). :- initialization(p, main). p.", []).
sample("p(X) :- must_be(list(pair), X), must_be(list(atom), X),
               must_be(oneof([a]), X).",
       [key(must_be/2)-pair]).
sample("p(X) :- maplist(must_be(type), X), is_of_type(bool, X),
               must_be(between(1, 2), X).",
       [key(must_be/2)-type, key(is_of_type/2)-bool]).
sample(":- multifile error:has_type/2.
        error:has_type(port, X) :- atom(X).
        p(X) :- must_be(list(port), X), must_be(pair, X).",
       [key(must_be/2)-pair]).
sample("p(X) :- prolog_load_context(reloading, X).
        p(X) :- prolog_load_context(file, X).",
       [key(prolog_load_context/2)-reloading]).
sample("p(X) :- statistics(stack_limit, X), statistics(cputime, X).",
       [key(statistics/2)-stack_limit]).
sample(":- style_check(-singleton), style_check(+no_effect).
        :- style_check(-trap).",
       [property(style_check/1)- -trap]).
sample("p(F, S) :- tmp_file_stream(F, S, [encoding(utf8)]).",
       [key(tmp_file_stream/3)-options]).
sample("p(F, S) :- tmp_file_stream(utf8, F, S).", []).

% ---------------- FORMATS

sample("p(X) :- format(\"~a ~`-t~30|~*c ~2f~h~n\", [X]).", [directive-h]).
sample("p(X) :- format(atom(X), '~:d ~~h', [1]), debug(x, '~z', [X]).",
       [directive-z]).
sample("p(X) :- print_message(error, format('~y', [X])).", [directive-y]).
sample(":- multifile prolog:message//1.
        prolog:message(p(X)) --> q(X), [ url(X), 'a ~w'-[f(X)], nl ].
        q(X) --> [ '~o'-[X] ].",
       [element-url/1, directive-o]).
sample(":- multifile prolog:message//1, prolog:deprecated/3.
        prolog:message(p) --> [ ansi(bold, a, []), nl ].
        prolog:deprecated(_, _, _) :- true.",
       [hook-deprecated/3]).

% ---------------- PREDICATES AND LIBRARIES

sample("p(X) :- string_predicate(X).", [predicate-string_predicate/1]).
sample("p(X) :- convlist(q, X, _), member(X, [a]). q(_, _).",
       [predicate-convlist/3]).
sample("p(X) :- user:unsetenv(X), system:nb_dict(X), \\+ is_assoc(X),
             user:print_message_lines(X), user:anything(X).",
       [predicate-nb_dict/1]).
sample("p(X) :- catch(thread_wait(X, []), _, tnot(X)).",
       [predicate-thread_wait/2, predicate-tnot/1]).
sample("p(X, Y) :- maplist([A, B]>>(B is A+1), X, Y).",
       [predicate-(>>)/4]).
sample(":- use_module(library(lists), [append/3, subseq/3]).",
       [library(lists)-subseq/3]).
sample(":- use_module(library(filesex),
                      [ directory_file_path/3, directory_member/3 ]).
        :- use_module(library(readutil), [read_file_to_string/3]).
        :- use_module(library(plunit)).
        :- use_module(library(process), [process_create/3 as run]).
        :- use_module(library(dcg/basics), [blanks//0, csym//1]).
        :- use_module(library(time), [call_with_time_limit/3]).",
       [ library(filesex)-directory_member/3, library(dcg/basics)-csym/3,
         library(time)-call_with_time_limit/3 ]).
sample(":- use_module([library(lists), library(yall)]).
        :- use_module(library(ev3dev/private/words)).",
       [library-yall]).
sample(":- use_module(library(clpfd)). p(X) :- X #> 3, label([X]).", []).
sample("p(X) :- label([X]).", [predicate-label/1]).
sample(":- autoload(library(lists), [member/2, pairs/2]).",
       [predicate-autoload/2, library(lists)-pairs/2]).
sample(":- table p/1. p(1).", [syntax-operator_expected]).
sample(":- table(p/1). p(1).", [predicate-(table)/1]).
sample(":- det(p/1). p(1).", [predicate-det/1]).
sample(":- dynamic q/1. :- thread_local([r/1]). :- multifile s//1.
        p :- q(1), r(1), phrase(s(1), []), s(1, a, b).",
       []).
sample(":- meta_predicate twice(0).
        twice(G) :- call(G), call(G).
        p :- twice(string_predicate(1)).",
       [predicate-string_predicate/1]).
sample("p --> q, { nb_dict(1) }, call(r), [x], !. q --> \"a\". r(_, _).",
       [predicate-nb_dict/1]).

% ---------------- SYNTAX

sample(":- use_module(library(ev3dev/rules)).\na :: true ~> true.", []).
sample("a :: true ~> true.", [syntax-operator_expected]).
sample("p(X), X > 3 => true.\np(_).", [syntax-operator_expected]).
sample("p(X) :- X = 1r3.", [syntax-1r3]).
sample("p(X) :- X = f(1.0Inf).", [syntax-Inf]) :-
    Inf is inf.
sample("p(X) :- X = _{a: 1_000}, q(\"a\", `b`, 'c', 0'd, a()).
        q(_, _, _, _, _).",
       []).
sample("p(D) :- X is D.count+1, ( X = [] | X = D.get(x) ).", []).
sample(":- op(700, xfx, =>). p(X => _) :- X => 3. _ => _.", []).

% ---------------- GUARDS

sample(":- if((current_prolog_flag(version, V), V >= 70508)).
        p(X) :- X is inf.
        :- else.
        p(X) :- '$cmd_option_val'(toplevel, X), q(X).
        :- endif.",
       [predicate-q/1]).
sample(":- if((current_prolog_flag(version, V), V < 70508)).
        p(X) :- q(X).
        :- elif(string_predicate(1)).
        p(X) :- X is inf.
        :- else.
        p(X) :- X is nan.
        :- endif.
        p(X) :- X is lcm(1, 2).",
       [predicate-q/1, function-lcm/2]).
sample(":- if(current_predicate(autoload/2)).
        :- autoload(library(lists), [member/2]).
        :- else.
        :- use_module(library(lists), [member/2]).
        :- endif.",
       []).
sample(":- if(exists_source(library(tables))).
        :- use_module(library(tables)).
        :- if(true).
        :- table(p/1).
        :- endif.
        :- endif.
        :- if(\\+ exists_source(library(tables))).
        p(X) :- nb_dict(X).
        :- endif.",
       [predicate-nb_dict/1]).
sample(":- if(\\+ catch(current_arithmetic_function(inf), _, fail)).
        p(X) :- X is nan.
        :- endif.",
       [function-nan/0]).
sample(":- if(string_predicate(1)).
        p(X) :- X is nan.
        :- else.
        p(X) :- X is inf.
        :- endif.",
       [predicate-string_predicate/1, function-inf/0, function-nan/0]).
sample(":- if(fail).\na => b.\n:- endif.", [syntax-operator_expected]).
sample("p(X) :- ( current_prolog_flag(version, V), V >= 90000
               -> X is inf ; X is nan ).",
       [function-nan/0]).
sample("p :- ( current_prolog_flag(gc_thread, _)
             -> set_prolog_flag(gc_thread, false)
             ; current_predicate(string_predicate/1) -> string_predicate(1)
             ; true ).",
       []).
sample("p(X) :- current_predicate(nb_dict/1), !, nb_dict(X).
        p(X) :- predicate_property(system:tnot(_), _), tnot(X).
        p(X) :- \\+ current_prolog_flag(bounded, X), tnot(X).",
       [predicate-tnot/1]).
sample("p(X) :- \\+ current_op(_, _, table), string_predicate(X).",
       [predicate-string_predicate/1]).
sample("p(X) :- ( q(X) -> nb_dict(X) ; true ), X is inf. q(_).",
       [predicate-nb_dict/1, function-inf/0]).
sample(":- dynamic q/1. p :- assertz((q(X) :- nb_dict(X))).",
       [predicate-nb_dict/1]).
