:- module(probes,
          [ probe/2,                    % ?Name, ?Command
            probing/2                   % +Kept, -Lines
          ]).

/** <module> What no program behind the fence may do

Each is a command of the shell that must fail there, also if root marks. `$KEPT` is a directory
outside, `$MARKER` the number of the marker's process. Outside, as root, some would succeed, and
mount over /tmp or rename the machine: so the program runs none where it sees /etc.
*/

%!  probe(?Name, ?Command) is nondet.

%   What is not there
probe(homes,             'ls -d /root/.[a-z]* || ls -d /home/*/.[a-z]*'). % not the pack there
probe(passwords,         'cat /etc/passwd || cat /etc/shadow').
probe(exercises,         'ls -d /tmp/*/batch.pl || ls -d /tmp/*/*/batch.pl').
probe(a_file_outside,    'cat $KEPT/secret || ls $KEPT').
probe(a_link_outside,    'ln -s $KEPT link; cat link/secret').
probe(through_proc,      'cat /proc/1/root/etc/passwd || ls /proc/1/cwd/../../../home').
probe(the_kernel,        'ls /sys || head -c 1 /proc/kcore || head -c 1 /dev/mem').
probe(disks,             'ls /dev/vd* || ls /dev/sd* || ls /dev/loop*').
probe(kernel_messages,   'head -c 1 /dev/kmsg').
probe(services,          'ls /run || ls /var').
probe(settings,          'ls /etc').
%   What others do
probe(secrets,           'env | grep EV3DEV_TEST_SECRET').
probe(a_secret_of_one,   'grep -a EV3DEV_TEST_SECRET /proc/*/environ').
probe(other_processes,   'kill -0 $MARKER').
probe(its_first_process, 'kill -9 1 && sleep 0.1 && ! kill -0 1').
probe(other_networks,    'grep -v -e lo: -e "|" /proc/net/dev').
probe(a_port,            'bash -c "exec 3<>/dev/tcp/127.0.0.1/22"').
probe(other_names,       'hostname cheat').
%   What it may not write
probe(the_pack,          'touch $PACK/prolog/x').
probe(its_compiled_form, 'touch $PACK/compiled/x').
probe(its_library,       'touch $PACK/lib/x').
probe(the_system,        'touch /usr/x || touch /bin/x || touch /lib/x').
probe(the_top,           'touch /x || mkdir /x').
probe(devices,           'touch /dev/x || touch /dev/shm/x').
probe(its_program,       'echo "start." >> $PROGRAM').
probe(its_program_away,  'rm -f $PROGRAM').
probe(rights_of_others,  'chmod 777 /usr/bin/env').
probe(its_robot_away,    'rm -f robot').
probe(another_robot,     'mv robot other').
probe(what_it_tells,     'rm -f told; test ! -e told').
probe(parameters,        'x=$(cat /proc/sys/kernel/domainname); echo $x > /proc/sys/kernel/domainname').
probe(core_dumps,        'x=$(cat /proc/sys/kernel/core_pattern); echo "$x" > /proc/sys/kernel/core_pattern').
probe(system_requests,   'echo h > /proc/sysrq-trigger').
probe(out_of_memory,     'echo 1 > /proc/self/oom_score_adj').
probe(a_program_of_all,  'ln /usr/bin/env env').
%   Rights that it does not get
probe(mounts,            'mount -t tmpfs none /tmp').
probe(mounts_again,      'mount -o remount,rw /usr || mount -o remount,rw $PACK/prolog || mount -o remount,rw /').
probe(unmounts,          'umount /proc || umount $PWD/robot').
probe(new_mounts,        'unshare -m true').
probe(new_users,         'unshare -U true || unshare -Ur true').
probe(another_room,      'nsenter -t 1 -m true').
probe(another_root,      'chroot / true').
probe(a_device,          'mknod block b 8 0').
probe(another_owner,     'touch mine; chown 1 mine').
probe(another_user,      'setpriv --reuid 1 true').
probe(a_higher_priority, 'renice -5 $$').
probe(the_clock,         'date -s @0').
probe(capabilities,      'grep -v 0000000000000000 /proc/self/status | grep Cap').
probe(new_privileges,    'grep "NoNewPrivs:.0" /proc/self/status').
%   Its limits
probe(a_long_file,       'head -c 2000000 /dev/zero > long').
probe(many_files,        'for n in $(seq 80); do head -c 1000000 /dev/zero > f$n || exit 1; done').
probe(many_in_tmp,       'for n in $(seq 80); do head -c 1000000 /dev/zero > /tmp/f$n || exit 1; done').
probe(more_time,         'ulimit -t unlimited').
probe(longer_files,      'ulimit -f unlimited').
probe(dumps,             'ulimit -c unlimited').

%!  probing(+Kept, -Lines) is det.
%
%   The lines of a program that prints the names of the probes that succeed. Kept is a directory.

probing(Kept, Lines) :-
    current_prolog_flag(pid, Marker),
    ev3dev_compiled:pack_folder(Pack),
    findall(Line,
            ( probe(Name, Command),
              format(string(Line), "probe(~q, ~q).", [Name, Command]) ),
            Probes),
    format(string(Sets), "    setenv('KEPT', ~q), setenv('MARKER', ~q), setenv('PACK', ~q),",
           [Kept, Marker, Pack]),
    append(Probes,
           [ "main :- exists_directory('/etc'), !, throw(no_fence).",
             "main :-", Sets,
             "    source_file(main, Program), setenv('PROGRAM', Program), us_dist_cm(in1, _),",
             "    forall(( probe(Name, Command), tried(Command) ), ( writeln(Name) )).",
             "tried(Command) :-",
             "    atomic_list_concat(['( ', Command, ' ) >/dev/null 2>&1'], All),",
             "    shell(All, 0)." ], Lines).
