:- module(ev3dev_marking_submissions,
          [ submissions/4,              % +Paths, +Goal, -Submissions, -Left
            own_submission/2,           % +File, -Submission
            can_be/2,                   % +Name0, -Name
            decoded/2                   % +Octets, -Text
          ]).
:- use_module('../files/directory', [new_directory/2]).
:- use_module(read, [program_terms/2]).
:- use_module(library(lists),
              [append/2, append/3, last/2, member/2, nth1/3, select/3]).
:- use_module(library(process), [process_create/3]).
:- use_module(library(readutil),
              [read_file_to_string/3, read_stream_to_codes/2]).
:- use_module(library(utf8), [utf8_codes/3]).

/** <module> What was handed in, and by whom

A submission is submission(Name, Keys, Files, Refused). Its Files are
file(Path, Bytes, Text, Terms), of which the first begins; Refused says why
there are none, else it is ''. Keys are of id(Id), Moodle's number;
user(User), GitHub's; and known(Text), an address or a number.

The forms in which learning platforms deliver a class:

  - Moodle: NAME_ID_assignsubmission_file/mine.pl, in older versions with one
    more `_`; or NAME_ID_assignsubmission_file_mine.pl if the teacher wants no
    folders. ID is that of the grading worksheet
    (mod/assign/classes/downloader.php of Moodle 4, get_student_prefix and
    load_submissionplugin_filelist).
  - GitHub Classroom: EXERCISE-USER/mine.pl, a clone for each student
    (cmd/gh-classroom/clone/student-repos of github.com/github/gh-classroom).
  - Gradescope: submission_N/mine.pl, and submission_metadata.yml with
    `:submitters:` of each folder: `:name:`, `:sid:`, `:email:`.
*/

%!  submissions(+Paths, +Goal, -Submissions, -Left) is det.
%
%   Paths are files, and folders with a file or a folder for each student.
%   Where several folders are named, one is itself a student's if one program
%   in it defines Goal, or if Moodle named it. Left is a list of
%   left(Path, Why), of what is not marked. No link is followed.

submissions(Paths, Goal, Submissions, Left) :-
    findall(Path, ( member(Path, Paths), exists_directory(Path) ), Folders),
    ( Folders = [_, _|_] -> Own = Goal ; Own = none ),
    setup_call_cleanup(
        new_directory(ev3dev_submissions, Links),
        findall(Handed,
                ( nth1(Index, Paths, Path),
                  handed(Path, Index, Own, Links, Handed) ),
                All),
        delete_links(Links)),
    merged(All, Merged),
    findall(Submission-Others,
            ( member(Handed, Merged),
              submitted(Handed, Goal, Submission, Others) ),
            Pairs),
    findall(Submission,
            ( member(Submission-_, Pairs), Submission \== none ),
            Submissions0),
    unique_names(Submissions0, Submissions),
    findall(One, ( member(_-Others, Pairs), member(One, Others) ), Left).

%!  own_submission(+File, -Submission) is det.
%
%   The program File of the caller, and the files beside it that it loads.

own_submission(File, submission(Name, [], Files, Refused)) :-
    base(File, Base),
    without_ending(Base, Name),
    content(File, program, Content),
    (   Content = file(_, Bytes, Text, Terms)
    ->  Refused = '',
        Files = [file(Base, Bytes, Text, Terms)|Others],
        file_directory_name(File, Folder),
        helpers([Terms], Folder, [Base], Others)
    ;   Content = left(Refused),
        Files = []
    ).

helpers(Programs, Folder, Seen, Files) :-
    (   member(Terms, Programs),
        member(term((:- Directive), _), Terms),
        mentions(Directive, Name),
        \+ sub_atom(Name, _, _, _, /),
        member(Ending, ['', '.pl']),
        atom_concat(Name, Ending, Base),
        \+ memberchk(Base, ['', '.', '..'|Seen]),
        path(Folder, Base, File),
        exists_file(File),
        content(File, program, file(_, Bytes, Text, Its))
    ->  Files = [file(Base, Bytes, Text, Its)|Files1],
        helpers([Its|Programs], Folder, [Base|Seen], Files1)
    ;   Files = []
    ).

% ---------------- WHOSE IT IS

%   handed(Place, Name, Keys, Items): what is in one Place is one submission,
%   if Name is not `none`. An item is item(Shown, Path, Content): Path leads
%   there from the student's folder, Content is left(Why) or
%   file(Kind, Bytes, Text, Terms), Kind `program` or `text`.

handed(File, Index, _, _, handed(Index, Name, [], Items)) :-
    \+ exists_directory(File),
    !,
    base(File, Base),
    ending(Base, _, Ending),
    archives(Archives),
    (   memberchk(Ending, ['', pl, pro, prolog, txt|Archives])
    ->  without_ending(Base, Name),
        content(File, program, Content)
    ;   Name = none,
        no_program(Why),
        Content = left(Why)
    ),
    Items = [item(File, Base, Content)].
handed(Folder, _, Goal, Links, handed(named-Place, Name, Keys, Items)) :-
    Goal \== none,
    absolute_file_name(Folder, Absolute0),
    (   atom_concat(Absolute, /, Absolute0)   % kept by SWI-Prolog 7.2.3
    ->  true
    ;   Absolute = Absolute0
    ),
    file_base_name(Absolute, Base),
    folder_items(Folder, Folder, '', Links, Items),
    (   moodle(Base, Place, Name, Keys)
    ->  true
    ;   findall(x,
                ( member(item(_, _, file(_, _, _, Terms)), Items),
                  defines(Terms, Goal) ),
                [_])
    ->  Place = Folder,
        Name = Base,
        Keys = []
    ),
    !.
handed(Folder, Index, _, Links, Handed) :-
    entries(Folder, Links, Entries),
    (   Entries == [unreadable]
    ->  Handed = handed(Index, none, [],
                        [item(Folder, '', left('It cannot be read.'))])
    ;   of_class(Folder, Index, Entries, Links, Handed)
    ).

of_class(Folder, Index, Entries, Links,
         handed(Index-Place, Name, Keys, Items)) :-
    metadata(Entries, Metadata),
    findall(Base, ( member(Base-File, Entries), is_folder(File) ), Bases),
    common_beginning(Bases, Beginning),
    member(Base-File, Entries),
    Base \== 'submission_metadata.yml',
    path(Folder, Base, Shown),
    (   is_folder(File)
    ->  \+ hidden(Base),
        folder_items(File, Shown, '', Links, Items)
    ;   findall(Item, item(File, Shown, Base, Item), Items),
        Items \== []
    ),
    (   moodle(Base, Place, Name, Keys)
    ->  true
    ;   is_folder(File)
    ->  Place = Base,
        (   memberchk(Base-Known, Metadata)
        ->  findall(N, member(name(N), Known), Names),
            atomic_list_concat(Names, ', ', Name),
            findall(known(Key),
                    ( member(Field, Known), arg(1, Field, Key) ), Keys)
        ;   Name = Base,
            ( atom_concat(Beginning, User, Base), Beginning \== '' ->
              Keys = [user(User)] ; Keys = [] )
        )
    ;   Place = Base,
        Keys = [],
        (   Items = [item(_, _, file(program, _, _, _))]
        ->  without_ending(Base, Name)
        ;   Name = none
        )
    ).

%   NAME_ID_assignsubmission_...

moodle(Base, Place, Name, Keys) :-
    sub_atom(Base, Before, _, _, '_assignsubmission_'),
    !,
    sub_atom(Base, 0, Before, _, Place),
    (   atomic_list_concat([Name, Id], '_', Place),
        atom_number(Id, Number),
        integer(Number)
    ->  Keys = [id(Id)]
    ;   Name = Place,
        Keys = []
    ).

%   The beginning with a hyphen that all folders have, of two or more.

common_beginning([First, Second|Others], Beginning) :-
    findall(Part,
            ( sub_atom(First, Before, 1, After, -),
              After > 0,
              Length is Before+1,
              sub_atom(First, 0, Length, _, Part),
              \+ ( member(One, [Second|Others]),
                   \+ sub_atom(One, 0, Length, _, Part) ) ),
            Parts),
    last(Parts, Beginning),
    !.
common_beginning(_, '').

%   Of submission_metadata.yml: Folder-[name(Name), sid(Sid), email(Email)].

metadata(Entries, Metadata) :-
    (   memberchk('submission_metadata.yml'-File, Entries),
        catch(read_file_to_string(File, Text, [encoding(utf8)]), _, fail)
    ->  split_string(Text, "\n", "\r", Lines),
        metadata_lines(Lines, none, Pairs),
        findall(Folder, member(Folder-_, Pairs), Folders0),
        sort(Folders0, Folders),
        findall(Folder-Fields,
                ( member(Folder, Folders),
                  findall(Field, member(Folder-Field, Pairs), Fields),
                  memberchk(name(_), Fields) ),
                Metadata)
    ;   Metadata = []
    ).

metadata_lines([], _, []).
metadata_lines([Line|Lines], Folder0, Pairs) :-
    (   split_string(Line, ":", " ", [Name, ""]),
        \+ sub_string(Line, 0, _, _, " ")
    ->  atom_string(Folder, Name),
        Pairs = Pairs1
    ;   Folder = Folder0,
        split_string(Line, ":", " -", ["", Key|Parts]),
        memberchk(Key, ["name", "sid", "email"]),
        joined(Parts, Value0),
        split_string(Value0, "", " '\"", [Value]),
        Value \== ""
    ->  atom_string(Functor, Key),
        atom_string(Atom, Value),
        Field =.. [Functor, Atom],
        Pairs = [Folder-Field|Pairs1]
    ;   Folder = Folder0,
        Pairs = Pairs1
    ),
    metadata_lines(Lines, Folder, Pairs1).

joined(Parts, String) :-
    atomic_list_concat(Parts, ':', Atom),
    atom_string(Atom, String).

%   Moodle has a folder for each kind of submission.

merged([], []).
merged([handed(Place, Name, Keys, Items)|All], [Handed|Merged]) :-
    (   select(handed(Place, _, _, More), All, Others)
    ->  append(Items, More, Both),
        merged([handed(Place, Name, Keys, Both)|Others], [Handed|Merged])
    ;   Handed = handed(Place, Name, Keys, Items),
        merged(All, Merged)
    ).

%   Of several with the same name, each has its number.

unique_names(Submissions0, Submissions) :-
    findall(Low, ( member(submission(Name, _, _, _), Submissions0),
                   downcase_atom(Name, Low) ), All),
    unique_names(Submissions0, All, [], Submissions).

unique_names([], _, _, []).
unique_names([submission(Name0, Keys, Files, Refused)|Submissions0], All,
             Taken, [submission(Name, Keys, Files, Refused)|Submissions]) :-
    downcase_atom(Name0, Low0),
    (   memberchk(id(Id), Keys),
        select(Low0, All, Others),
        memberchk(Low0, Others)
    ->  atomic_list_concat([Name0, Id], ' ', First)
    ;   First = Name0
    ),
    free_name(First, 2, Taken, Name, Low),
    unique_names(Submissions0, All, [Low|Taken], Submissions).

free_name(Name0, Number, Taken, Name, Low) :-
    (   Number =:= 2
    ->  Name1 = Name0
    ;   Before is Number-1,
        atomic_list_concat([Name0, Before], ' ', Name1)
    ),
    downcase_atom(Name1, Low1),
    (   memberchk(Low1, Taken)
    ->  Next is Number+1,
        free_name(Name0, Next, Taken, Name, Low)
    ;   Name = Name1,
        Low = Low1
    ).

% ---------------- WHICH FILES

%   Others is a list of left(Path, Why).

submitted(handed(_, Name, _, Items), _, none, Others) :-
    Name == none,
    !,
    others(Items, Others).
submitted(handed(_, Name, Keys, Items), Goal,
          submission(Name, Keys, Files, Refused), Others) :-
    (   member(Kind, [program, text]),
        findall(file(Path, Bytes, Text, Terms),
                member(item(_, Path, file(Kind, Bytes, Text, Terms)), Items),
                Found),
        Found \== []
    ->  begins(Found, Goal, Files, Beside),
        findall(Bytes, member(file(_, Bytes, _, _), Files), All),
        atomic_list_concat(All, Whole),
        atom_length(Whole, Length),
        most_text(Most),
        ( Length > Most -> Refused = 'It is longer than 1 MB.'
        ; Refused = '' ),
        findall(item(Shown, Path, left(Why)),
                ( member(item(Shown, Path, Content), Items),
                  (   memberchk(Path-Why, Beside)
                  ->  true
                  ;   Content = left(Why)
                  ;   Kind == program,
                      Content = file(text, _, _, _),
                      no_program(Why)
                  ) ),
                Its)
    ;   Files = [],
        (   Items = [item(_, _, left(Refused))]
        ->  Its = []
        ;   Its = Items,
            Refused = 'There is no program (*.pl) in what was handed in.'
        )
    ),
    others(Its, Others).

others(Items, Others) :-
    findall(left(Shown, Why),
            ( member(item(Shown, _, Content), Items),
              ( Content = left(Why) -> true ; no_program(Why) ) ),
            Others).

no_program('Its name does not end in .pl.').

most_text(1000000).

%   The file that defines Goal begins; of several the first that no other one
%   loads. Those do not run.

begins(Found, Goal, [First|Rest], Beside) :-
    findall(Path, ( member(file(Path, _, _, Terms), Found),
                    defines(Terms, Goal) ), Defining),
    findall(Path, ( member(file(Path, _, _, _), Found),
                    \+ ( member(file(By, _, _, Terms), Found),
                         By \== Path,
                         loads(Terms, Path) ) ), Roots),
    (   member(Begins, Defining),
        memberchk(Begins, Roots)
    ->  true
    ;   append([Defining, Roots, [Any]], [Begins|_]),
        Found = [file(Any, _, _, _)|_]
    ),
    functor(Goal, Name, Arity),
    format(atom(Why), '~w has ~w/~w, too, and was run.',
           [Begins, Name, Arity]),
    findall(Path-Why,
            ( member(Path, Defining),
              Path \== Begins,
              memberchk(Path, Roots) ),
            Beside),
    First = file(Begins, _, _, _),
    select(First, Found, Others),
    findall(File,
            ( member(File, Others),
              File = file(Path, _, _, _),
              \+ memberchk(Path-_, Beside) ),
            Rest).

defines(Terms, Goal) :-
    functor(Goal, Name, Arity),
    member(term(Term, _), Terms),
    ( Term = (Head :- _) -> true ; Head = Term ),
    callable(Head),
    functor(Head, Name, Arity),
    !.

loads(Terms, Path) :-
    base(Path, Base),
    without_ending(Base, Name),
    member(term((:- Directive), _), Terms),
    mentions(Directive, Atom),
    base(Atom, Last),
    memberchk(Last, [Base, Name]),
    !.

mentions(Term, Atom) :-
    (   atom(Term)
    ->  Atom = Term
    ;   compound(Term),
        Term =.. [_|Arguments],
        member(Argument, Arguments),
        mentions(Argument, Atom)
    ).

% ---------------- FILES

folder_items(Folder, Shown, Path, Links, Items) :-
    entries(Folder, Links, Entries),
    (   Entries == [unreadable]
    ->  Items = [item(Shown, Path, left('It cannot be read.'))]
    ;   findall(Item,
                ( member(Base-File, Entries),
                  path(Shown, Base, Shown1),
                  ( Path == '' -> Path1 = Base ; path(Path, Base, Path1) ),
                  (   is_folder(File)
                  ->  \+ hidden(Base),
                      folder_items(File, Shown1, Path1, Links, Its),
                      member(Item, Its)
                  ;   item(File, Shown1, Path1, Item)
                  ) ),
                Items)
    ).

%   What is hidden by macOS, git and others has no word.

hidden(Base) :-
    sub_atom(Base, 0, _, _, '.'),
    !.
hidden('__MACOSX').

item(link, Shown, Path, item(Shown, Path, left(Why))) :-
    !,
    Why = 'It is a link, which is not followed.'.
item(File, Shown, Path, item(Shown, Path, Content)) :-
    base(Path, Base),
    ending(Base, _, Ending),
    (   memberchk(Ending, [pl, pro, prolog]),
        \+ sub_atom(Base, 0, _, _, '._')
    ->  Kind = program
    ;   \+ hidden(Base),
        Kind = text
    ),
    archives(Archives),
    (   Kind == text,
        \+ memberchk(Ending, [txt|Archives])
    ->  no_program(Why),
        Content = left(Why)
    ;   content(File, Kind, Content)
    ).

archives([zip, tar, gz, tgz, '7z', rar]).

content(File, Kind, Content) :-
    base(File, Base),
    ending(Base, _, Ending),
    archives(Archives),
    (   memberchk(Ending, Archives)
    ->  Content = left('It is an archive: unpack it first.')
    ;   \+ exists_file(File)
    ->  Content = left('It cannot be read.')
    ;   size_file(File, Size),
        most_text(Most),
        Size > Most
    ->  Content = left('It is longer than 1 MB.')
    ;   catch(read_file_to_string(File, Bytes, [encoding(octet)]), _, fail)
    ->  decoded(Bytes, Text),
        program_terms(Text, Terms),
        Content = file(Kind, Bytes, Text, Terms)
    ;   Content = left('It cannot be read.')
    ).

%   Prolog's own predicates throw where the locale lacks a letter. Some
%   browsers and editors make mine.pl.txt of mine.pl.

base(Path, Base) :-
    atomic_list_concat(Parts, /, Path),
    last(Parts, Base).

ending(Base, Name, Ending) :-
    downcase_atom(Base, Low),
    atomic_list_concat(Parts, '.', Low),
    (   append(_, [pl, txt], Parts)
    ->  Ending = pl,
        Length = 7
    ;   append([_|_], [Ending], Parts)
    ->  atom_length(Ending, Length0),
        Length is Length0+1
    ;   Ending = '',
        Length = 0
    ),
    sub_atom(Base, 0, _, Length, Name).

without_ending(Base, Name) :-
    (   ending(Base, Name0, Ending),
        memberchk(Ending, [pl, pro, prolog, txt]),
        Name0 \== ''
    ->  Name = Name0
    ;   Name = Base
    ).

is_folder(File) :-
    File \== link,
    exists_directory(File).

%   directory_file_path/3 throws where the locale lacks a letter of Base.

path(Folder0, Base, Path) :-
    ( atom_concat(Folder, /, Folder0) -> true ; Folder = Folder0 ),
    atomic_list_concat([Folder, /, Base], Path).

%   Base-File, File being where it can be read, or `link`. Where a name is no
%   UTF-8, directory_files/2 throws, or gives a name that open/3 does not
%   find: then the shell makes a link to each.

entries(Folder, Links, Entries) :-
    (   catch(directory_files(Folder, Bases0), error(_, _), fail)
    ->  msort(Bases0, Bases),
        findall(Base-File,
                ( member(Base, Bases),
                  \+ memberchk(Base, ['.', '..']),
                  path(Folder, Base, Path),
                  (   catch(read_link(Path, _, _), error(_, _), true)
                  ->  File = link
                  ;   File = Path
                  ) ),
                Entries)
    ;   linked(Folder, Links, Entries)
    ).

linked(Folder, Links, Entries) :-
    new_directory(ev3dev_links, Directory0),
    file_base_name(Directory0, Last),
    path(Links, Last, Directory),
    rename_file(Directory0, Directory),
    setup_call_cleanup(
        process_create(path(sh),
            [ '-c', 'case $1 in /*) d=$1 ;; *) d=$PWD/$1 ;; esac; n=0
               for f in "$d"/* "$d"/.[!.]* "$d"/..?*; do
                 if [ -L "$f" ]; then k=l; elif [ -e "$f" ]; then k=f
                 else continue; fi
                 n=$((n+1)); ln -s "$f" "$2/$n"
                 printf "%s%s\\0" $k "${f##*/}"
               done', sh, file(Folder), file(Directory) ],
            [stdout(pipe(Out)), stderr(null)]),
        ( set_stream(Out, encoding(octet)),
          read_stream_to_codes(Out, Codes) ),
        close(Out)),
    split_names(Codes, Names),
    (   Names == []
    ->  Entries = [unreadable]
    ;   findall(Base-File,
                ( nth1(N, Names, [Kind|Bytes]),
                  string_codes(Octets, Bytes),
                  decoded(Octets, Text),
                  atom_string(Base, Text),
                  ( Kind =:= 0'l -> File = link
                  ; path(Directory, N, File) ) ),
                Entries)
    ).

%   Nothing that a link leads to is touched.

delete_links(Links) :-
    forall(within(Links, Directory),
           ( forall(within(Directory, Link), delete_file(Link)),
             delete_directory(Directory) )),
    delete_directory(Links).

within(Directory, Path) :-
    directory_files(Directory, Bases),
    member(Base, Bases),
    \+ memberchk(Base, ['.', '..']),
    path(Directory, Base, Path).

split_names(Codes, Names) :-
    (   append(Name, [0|Rest], Codes)
    ->  Names = [Name|Names1],
        split_names(Rest, Names1)
    ;   Names = []
    ).

%!  decoded(+Octets, -Text) is det.
%
%   Octets are UTF-8, UTF-16 with a mark at its beginning, else Latin-1.

decoded(Octets, Text) :-
    string_codes(Octets, Bytes),
    (   append([0xEF, 0xBB, 0xBF], Rest, Bytes),
        phrase(utf8_codes(Codes), Rest)
    ->  true
    ;   append([0xFF, 0xFE], Rest, Bytes)
    ->  pairs(Rest, 1, 256, Codes)
    ;   append([0xFE, 0xFF], Rest, Bytes)
    ->  pairs(Rest, 256, 1, Codes)
    ;   phrase(utf8_codes(Codes), Bytes)
    ->  true
    ;   Codes = Bytes
    ),
    string_codes(Text, Codes).

pairs([A, B|Bytes], First, Second, [Code|Codes]) :-
    !,
    Code is A*First + B*Second,
    pairs(Bytes, First, Second, Codes).
pairs(_, _, _, []).

%!  can_be(+Name0, -Name) is det.
%
%   Name is Name0 as far as the locale can write it, in one line.

can_be(Name0, Name) :-
    atom_concat(/, Name0, Whole),
    (   catch(is_absolute_file_name(Whole), error(_, _), fail)
    ->  Last = 0x10ffff
    ;   Last = 127
    ),
    atom_codes(Name0, Codes0),
    findall(Code,
            ( member(Code0, Codes0),
              ( between(32, Last, Code0) -> Code = Code0 ; Code = 0'_ ) ),
            Codes),
    atom_codes(Name, Codes).
