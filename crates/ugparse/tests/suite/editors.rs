//! What follows from the table of statements outside of the library: the forms in the manual, words
//! for editors, and the dictionary of the fuzz targets.
//!
//! `UG_BLESS=1` writes them anew; review the difference.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value, json};
use ugparse::{STATEMENTS, Statement};

/// Compares a file of the repository with what it should be, or writes it.
fn check(path: &str, expected: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    if std::env::var_os("UG_BLESS").is_some() {
        fs::write(&file, expected).unwrap();
    }
    let found = fs::read_to_string(&file).unwrap_or_default();
    assert!(
        found == expected,
        "{path} does not follow from the table of statements: \
         `UG_BLESS=1 cargo test -p ugparse --test suite editors`\n{expected}"
    );
}

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)).unwrap()
}

/// The form of a statement in the manual, where a velocity stands for all motions.
fn manual_form(statement: &Statement) -> String {
    statement.form().replace("< vx vy vz >", "< motion >")
}

/// The words of options, each once.
fn option_words() -> BTreeSet<&'static str> {
    let options = STATEMENTS.iter().flat_map(Statement::options);
    options.map(|form| form.split(' ').next().unwrap()).collect()
}

#[test]
fn the_manual_has_the_form_of_every_statement() {
    let page = read("docs/unigrafix.md");
    let form = |line: &str| {
        let mut words = line.strip_prefix("    ")?.split(' ').filter(|word| !word.is_empty());
        let statement =
            STATEMENTS.iter().find(|other| Some(other.keyword) == words.clone().next())?;
        let is_form = matches!(words.nth(1)?, "ID" | "[ID]" | "FILE");
        is_form.then_some(statement)
    };
    let mut found = BTreeSet::new();
    let lines = page.lines().map(|line| match form(line) {
        Some(statement) if found.insert(statement.keyword) => {
            format!("    {}\n", manual_form(statement))
        }
        _ => format!("{line}\n"),
    });
    let expected: String = lines.collect();
    // `end` is in the form of `def`.
    let missing: Vec<_> = (STATEMENTS.iter())
        .filter(|row| !found.contains(row.keyword) && row.keyword != "end")
        .map(manual_form)
        .collect();
    assert_eq!(missing, [""; 0], "forms that docs/unigrafix.md lacks");
    check("docs/unigrafix.md", &expected);
}

/// Options are in tables, in which some share a row: "`-og`, `-ps`".
#[test]
fn the_manual_has_every_option() {
    let pages = read("docs/unigrafix.md") + &read("docs/motion.md");
    for statement in STATEMENTS {
        for form in statement.options() {
            let (word, _) = form.split_once(' ').unwrap_or((form, ""));
            let is_whole = [format!("`-{form}`"), format!("-{form}]"), format!("-{form} ")];
            let has_own_column = format!("`-{word}`");
            assert!(
                is_whole.iter().any(|form| pages.contains(form))
                    || pages
                        .lines()
                        .any(|line| line.starts_with('|') && line.contains(&has_own_column)),
                "{}: docs/unigrafix.md and docs/motion.md lack `-{form}`",
                statement.keyword
            );
        }
    }
}

#[test]
fn messages_name_every_option() {
    for (scene, keyword) in [
        ("cam -x;", "cam"),
        ("motion m -x;", "motion"),
        ("c w 1; c_tex w a.png -x;", "c_tex"),
        ("c_time t -x 0 w;", "c_time"),
        ("l 1 0 0 1 0 -x;", "l"),
        ("sky day -x;", "sky"),
    ] {
        let source = ugparse::Source::new("test.ug", scene);
        let found = ugparse::parse(&source, &ugparse::Options::default()).unwrap_err();
        let statement = STATEMENTS.iter().find(|row| row.keyword == keyword).unwrap();
        let inside = ["gamma", "at", "turn", "shift"];
        for form in statement.options() {
            let word = form.split(' ').next().unwrap();
            if keyword == "motion" || !inside.contains(&word) {
                let message = &found.list[0].message;
                assert!(message.contains(&format!("-{word}")), "{message} lacks -{word}");
            }
        }
    }
}

/// `ugmeshfile` recognises a scene by its first word.
#[test]
fn scenes_are_told_from_meshes_by_every_keyword() {
    for Statement { keyword, .. } in STATEMENTS {
        let text = format!("{keyword} x ;");
        let format = ugmeshfile::MeshFormat::detect("<stdin>", text.as_bytes());
        assert_eq!(format, Some(ugmeshfile::MeshFormat::Ug), "{text}");
    }
}

/// The words of options with their dashes, as a list.
fn dashed(between: &str) -> String {
    option_words().iter().map(|word| format!("-{word}")).collect::<Vec<_>>().join(between)
}

fn keywords(between: &str) -> String {
    STATEMENTS.iter().map(|row| row.keyword).collect::<Vec<_>>().join(between)
}

/// Vim colours words, and completes them with Control-X Control-O.
#[test]
fn vim_has_every_word() {
    let [keywords, options] = [keywords(" "), dashed(" ")];
    let text = format!(
        r#"" UniGrafix scenes for Vim. Copy this file to ~/.vim/syntax, and add to ~/.vimrc
"   autocmd BufRead,BufNewFile *.ug set filetype=unigrafix
"   autocmd FileType unigrafix set omnifunc=syntaxcomplete#Complete commentstring={{%s}}
" Written by the tests of ugparse from its table of statements.
if exists("b:current_syntax") | finish | endif
setlocal iskeyword=@,48-57,_,:,#,-
syn keyword ugKeyword contained {keywords}
syn keyword ugOption {options}
syn match ugStatement /\%(^\|[;}}]\)\@1<=\s*\h\w*/ contains=ugKeyword
syn match ugNumber /[-+]\?\%(\d\+\.\?\d*\|\.\d\+\)\%([eE][-+]\?\d\+\)\?\>/
syn region ugString start=/"/ end=/"/ oneline
syn region ugComment start=/{{/ end=/}}/ contains=ugComment
hi def link ugKeyword Statement
hi def link ugOption Type
hi def link ugNumber Number
hi def link ugString String
hi def link ugComment Comment
let b:current_syntax = "unigrafix"
"#
    );
    check("docs/editors/unigrafix.vim", &text);
}

/// A grammar of TextMate, and snippets, which VS Code and others read.
#[test]
fn textmate_has_every_word() {
    let pattern = |name: &str, pattern: &str| json!({ "name": name, "match": pattern });
    let begin = format!(r"(?:(?<=[;}}])|^)\s*({})(?=[\s;(<{{])", keywords("|"));
    let grammar = json!({
        "scopeName": "source.unigrafix",
        "name": "UniGrafix",
        "fileTypes": ["ug"],
        "patterns": [
            { "include": "#comment" },
            { "name": "string.quoted.double", "begin": "\"", "end": "\"|$" },
            { "match": begin, "captures": { "1": { "name": "keyword.control.unigrafix" } } },
            pattern("storage.modifier.unigrafix", &format!(r"(?<=\s)(?:{})(?=[\s;)>])", dashed("|"))),
            pattern("constant.numeric.unigrafix", r"(?<![\w:#])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"),
        ],
        "repository": { "comment": {
            "name": "comment.block.unigrafix", "begin": "\\{", "end": "\\}",
            "patterns": [{ "include": "#comment" }]
        } },
    });
    check("docs/editors/unigrafix.tmLanguage.json", &format!("{grammar:#}\n"));
    let snippets: Map<String, Value> = (STATEMENTS.iter())
        .map(|row| {
            let body = format!("{} $0;", row.keyword);
            let snippet =
                json!({ "prefix": row.keyword, "body": body, "description": manual_form(row) });
            (row.keyword.to_owned(), snippet)
        })
        .collect();
    check("docs/editors/unigrafix.code-snippets.json", &format!("{:#}\n", Value::Object(snippets)));
}

/// The words that libFuzzer puts into its inputs.
#[test]
fn the_fuzz_targets_have_every_word() {
    let words = STATEMENTS.iter().map(|row| format!("\"{} \"\n", row.keyword));
    let options = option_words().into_iter().map(|word| format!("\" -{word} \"\n"));
    let head = "# Written by the tests of ugparse from its table of statements.\n".to_owned();
    let lines: String = std::iter::once(head).chain(words).chain(options).collect();
    check("fuzz/unigrafix.dict", &lines);
}
