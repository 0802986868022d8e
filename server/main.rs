//! The `ferry` command.

fn main() -> std::process::ExitCode {
    match ferry::cli::run(std::env::args_os()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("ferry: {error:#}");
            std::process::ExitCode::FAILURE
        }
    }
}
