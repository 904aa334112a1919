#!/bin/sh
# Put Markermend into the menus of this user and open .c3d files with it; --remove takes it out.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
share=${XDG_DATA_HOME:-$HOME/.local/share}
bin=$HOME/.local/bin
desktop=$share/applications/markermend.desktop
mime=$share/mime/packages/markermend-c3d.xml

if [ "${1:-}" = --remove ]; then
    rm -f "$desktop" "$mime" "$bin/markermend" "$bin/markermend-window" \
        "$share"/icons/hicolor/*/apps/markermend.png
else
    mkdir -p "$bin" "$(dirname "$desktop")" "$(dirname "$mime")"
    ln -sf "$here/markermend" "$here/markermend-window" "$bin"
    sed "s|^Exec=.*|Exec=\"$here/markermend-window\" %f|" "$here/markermend.desktop" >"$desktop"
    cp "$here/markermend-c3d.xml" "$mime"
    for size in 16 24 32 48 64 128 256 512; do
        folder=$share/icons/hicolor/${size}x$size/apps
        mkdir -p "$folder"
        cp "$here/icons/markermend-$size.png" "$folder/markermend.png"
    done
fi
if command -v update-desktop-database >/dev/null; then update-desktop-database "$share/applications"; fi
if command -v update-mime-database >/dev/null; then update-mime-database "$share/mime"; fi
if [ "${1:-}" = --remove ]; then
    echo "Markermend is out of the menus; delete $here to remove it."
else
    echo "Markermend is in the menus now, and as “markermend” in $bin."
fi
