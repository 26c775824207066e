# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Completion of lsdcd's words in bash: commands, shapes and options as --help has them, else files.
_lsdcd() {
  local program=$1 current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} commands=() help
  # The words up to here that are commands: one, or two after generate.
  local first=${COMP_WORDS[1]} second=${COMP_WORDS[2]}
  if [ "$COMP_CWORD" -gt 1 ]; then commands=("$first"); fi
  if [ "$COMP_CWORD" -gt 2 ] && [ "$first" = generate ]; then commands=("$first" "$second"); fi
  help=$("$program" "${commands[@]}" --help 2>/dev/null) || return 0
  COMPREPLY=()
  if [ "$before" = --device ]; then
    COMPREPLY=($(compgen -W "auto cpu cuda" -- "$current"))
  elif [ "$before" = --units ] && [ "$first" = convert ]; then
    COMPREPLY=($(compgen -W "m cm mm um in ft" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$(grep -oE '^  [^ ]*--?[a-z][a-z-]*[^ ]*' <<<"$help" | tr ', ' '\n\n')" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\).*/\1/p' <<<"$help")" -- "$current"))
  fi
}
complete -o default -F _lsdcd lsdcd
