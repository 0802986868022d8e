//! The `ferry` command.

/// Training allocates and frees tensors thousands of times a second; glibc would return each to the system, which then
/// clears the memory again.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    match ferry::cli::run(std::env::args_os(), ferry_assets::FILES) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("ferry: {error:#}");
            std::process::ExitCode::FAILURE
        }
    }
}
