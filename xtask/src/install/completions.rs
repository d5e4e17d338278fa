//! Scripts by which shells ask a program for completions, and add file names where it says so.

/// For bash.
pub fn bash(program: &str) -> String {
    format!(
        r#"# Completion of {program} for bash.
_{program}() {{
    local line cur=${{COMP_WORDS[COMP_CWORD]}}
    COMPREPLY=()
    while IFS= read -r line; do
        if [[ $line == / ]]; then
            compopt -o filenames
            mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$cur")
        else
            COMPREPLY+=("${{line%%$'\t'*}}")
        fi
    done < <({program} --complete "${{COMP_WORDS[@]:1:COMP_CWORD}}" 2> /dev/null)
}}
complete -F _{program} {program}
"#
    )
}

/// For zsh.
pub fn zsh(program: &str) -> String {
    format!(
        r#"#compdef {program}
# Completion of {program} for zsh.
local line
local -a found
for line in "${{(@f)$({program} --complete "${{(@)words[2,CURRENT]}}" 2> /dev/null)}}"; do
    [[ $line != ?*$'\t'* ]] || found+=("${{line/$'\t'/:}}")
done
(( $#found )) && _describe completion found
[[ $line == / ]] && _files
"#
    )
}

/// For fish.
pub fn fish(program: &str) -> String {
    format!(
        r#"# Completion of {program} for fish.
function __{program}_complete
    set -l words (commandline -opc)
    set -l typed (commandline -ct)
    for line in ({program} --complete $words[2..-1] "$typed" 2> /dev/null)
        if test "$line" = /
            __fish_complete_path "$typed"
        else
            echo $line
        end
    end
end
complete -c {program} -f -a '(__{program}_complete)'
"#
    )
}
