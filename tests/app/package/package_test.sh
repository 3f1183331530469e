#!/usr/bin/env bash
# Makes the Debian packages. In a bare Debian 12 they are installed, a first dataset is made of the
# example scene and verified, and after a purge nothing is left. Usage: package_test.sh BUILD_FOLDER
# Needs root, mounts, debootstrap and Debian's packages; skipped (77) where they are missing.
set -euo pipefail
skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" = 0 ] || skip "needs root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"

root=$(mktemp -d)
packages=$(mktemp -d)
trap 'umount -R "$root/proc" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system "$root" "$root.log" "$packages"' EXIT
mkdir "$root/proc" "$root/dev"
mount -t proc proc "$root/proc" 2>/dev/null && mount --bind /dev "$root/dev" 2>/dev/null ||
    skip "file systems cannot be mounted here"
umount "$root/proc" "$root/dev"

echo "== packing"
cpack --config "$1/CPackConfig.cmake" -B "$packages" >"$root.log" || { cat "$root.log"; exit 1; }

if command -v lintian >/dev/null; then
    echo "== lintian"
    lintian --fail-on error --allow-root "$packages"/*.deb
fi

inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@"; }
# Where packages come from, as on this machine.
mirror=$(awk '/^URIs:/ {print $2; exit} /^deb / {for (i = 2; i <= NF; ++i) if ($i ~ /^[a-z]+:/) {print $i; exit}}' \
    /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources 2>/dev/null || true)
echo "== debootstrap"
debootstrap --variant=minbase bookworm "$root" ${mirror:+"$mirror"} >"$root.log" 2>&1 ||
    { tail -3 "$root.log"; skip "no Debian archive can be reached"; }
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"
inside apt-get update -qq
cp "$packages"/*.deb "$root/root/"
before=$(inside dpkg-query -W -f '${Package}\n')
list() { (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./tmp -o -path ./var/cache \
    -o -path ./var/lib/apt -o -path ./var/log -o -path ./root \) -prune -o -print | sort); }
list >"$root/root/before"

echo "== from apt install to a first dataset"
begin=$(date +%s)
inside sh -c 'apt-get install -y -qq --no-install-recommends /root/dollytrack_*.deb >/dev/null'
installed=$(date +%s)
inside dollytrack export /usr/share/dollytrack/scenes/apartment.glb --out /root/dataset \
    --max-frames 60 --quiet
end=$(date +%s)
echo "installed in $((installed - begin)) s, first dataset after $((end - begin)) s"
inside dollytrack verify /root/dataset

echo "== libraries that are loaded when they are needed"
export_more() { inside dollytrack -q export /usr/share/dollytrack/scenes/apartment.glb --out /root/more \
    --max-frames 2 --modalities rgb,depth,instance,semantic --formats "$1"; }
for format in video:libavformat59 hdf5:libhdf5-103-1; do
    if export_more "${format%:*}" 2>"$root/root/message"; then exit 1; fi
    grep -q "${format#*:}" "$root/root/message"
done
inside sh -c 'apt-get install -y -qq --no-install-recommends libavformat59 libhdf5-103-1 >/dev/null
    apt-mark auto libavformat59 libhdf5-103-1 >/dev/null'  # so that autoremove removes them
export_more video,hdf5
inside dollytrack verify /root/more

echo "== all packages"
inside sh -c 'apt-get install -y -qq --no-install-recommends /root/*.deb >/dev/null'
inside dollytrack-editor --version
test -e "$root/usr/share/applications/dollytrack-editor.desktop"

echo "== purge"
inside sh -c 'apt-get purge -y -qq "*dollytrack*" >/dev/null; apt-get autoremove --purge -y -qq >/dev/null'
after=$(inside dpkg-query -W -f '${Package}\n')
[ "$before" = "$after" ]
list >"$root/root/after"
# What other packages leave is theirs.
if comm -13 "$root/root/before" "$root/root/after" | grep -i dollytrack; then
    echo "left behind"; exit 1
fi
find "$root" -xdev -iname '*dollytrack*' -not -path "$root/root/*" | grep . && exit 1
echo "nothing is left"
