//! `ugsheet`: see the library of the same name.

fn main() -> std::process::ExitCode {
    ugsheet::main()
}
