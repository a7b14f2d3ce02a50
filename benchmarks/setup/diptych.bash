# bash completion for diptych: verbs, their options, cases and keys, all asked of the program itself.
_diptych() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} program=${COMP_WORDS[0]}
  local verb=${COMP_WORDS[1]}
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W "$("$program" --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p') --help --version" -- "$word"))
    return
  fi
  case $before in
    --out | --cases | --baselines) COMPREPLY=($(compgen -d -- "$word")) && return ;;
    --page | --junit | --json) COMPREPLY=($(compgen -f -- "$word")) && return ;;
    --partition) COMPREPLY=($(compgen -W "metis slab bisection" -- "$word")) && return ;;
    --restart) COMPREPLY=($(compgen -W latest -- "$word") $(compgen -f -- "$word")) && return ;;
    --method) COMPREPLY=($(compgen -W "sph fvm both" -- "$word")) && return ;;
  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$("$program" "$verb" --help 2>/dev/null | grep -oE -- '--[a-z-]+')" -- "$word")) ;;
    *)
      local words=""
      case $verb in
        explain) words=$("$program" explain all 2>/dev/null | sed -nE 's/^## `\[+([a-z.]+).*/[\1/p; s/^[|] `([A-Za-z_0-9.]+)`.*/\1/p' |
        awk '/^\[/ { section = substr($0, 2) "."; next } { print section $0 }') ;;
        list | cost | verify) ;;
        *) words=$("$program" list 2>/dev/null | cut -d' ' -f1) ;;
      esac
      COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
      ;;
  esac
}
complete -o filenames -F _diptych diptych
