#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# make_html.sh FOLDER: makes HTML of all pages there; warnings, as of links without a target, are errors.
set -euo pipefail
folder=$(realpath -m "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
python=/usr/bin/python3    # Debian's, which sees Debian's modules
"$python" -c "import sphinx, myst_parser, sphinx_rtd_theme" 2>/dev/null || { echo "skipped: no Sphinx with MyST"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"
"$python" -m sphinx -W --keep-going -q -b html -c doc -d "$folder-doctrees" . "$folder" </dev/null
