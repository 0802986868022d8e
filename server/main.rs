//! The `ferry` command.

/// Tensors come and go thousands of times a second; glibc would give each back to the system and have it zeroed anew.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    match ferry::cli::run(std::env::args_os()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("ferry: {error:#}");
            std::process::ExitCode::FAILURE
        }
    }
}
