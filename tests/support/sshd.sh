#!/usr/bin/env bash
# Usage: sshd.sh FOLDER SWIPL LIBRARY
#
# A server of OpenSSH for this user, on a port of the loopback device, with keys of its own,
# until the standard input ends. Prints its process when it listens. FOLDER/bin then has an
# `ssh` that knows it as the host `eva`, where `swipl` is SWIPL and finds the pack in LIBRARY.
set -euo pipefail
folder=$1 swipl=$(command -v "$2") library=$3
server=$(PATH=$PATH:/usr/sbin command -v sshd)
client=$(command -v ssh)

mkdir -p "$folder/bin"
chmod 700 "$folder"
for key in host user; do
    ssh-keygen -q -t ed25519 -N '' -f "$folder/$key"
done
cp "$folder/user.pub" "$folder/authorized"
printf 'eva %s\n' "$(cat "$folder/host.pub")" >"$folder/known"
cat >"$folder/bin/swipl" <<END
#!/bin/sh
exec '$swipl' -p library='$library' -f none "\$@"
END
cat >"$folder/bin/ssh" <<END
#!/bin/sh
exec '$client' -F '$folder/client' "\$@"
END
chmod +x "$folder/bin/swipl" "$folder/bin/ssh"
# Where root starts it, it needs this directory.
[ "$(id -u)" != 0 ] || mkdir -p /run/sshd

for _ in {1..20}; do
    port=$((20000 + RANDOM))
    cat >"$folder/server.conf" <<END
ListenAddress 127.0.0.1:$port
HostKey $folder/host
AuthorizedKeysFile $folder/authorized
PidFile none
PasswordAuthentication no
KbdInteractiveAuthentication no
UsePAM no
StrictModes no
LoginGraceTime 0
PermitRootLogin prohibit-password
SetEnv PATH=$folder/bin:/usr/bin:/bin
END
    cat >"$folder/client" <<END
Host eva
    HostName 127.0.0.1
    HostKeyAlias eva
    Port $port
    User $(id -un)
    IdentityFile $folder/user
    IdentitiesOnly yes
    UserKnownHostsFile $folder/known
    BatchMode yes
END
    "$server" -D -e -f "$folder/server.conf" 2>"$folder/log" &
    process=$!
    until grep -q 'Server listening' "$folder/log"; do
        kill -0 $process 2>/dev/null || continue 2
        sleep 0.05
    done
    echo "$process."
    cat >/dev/null
    kill $process
    exit
done
