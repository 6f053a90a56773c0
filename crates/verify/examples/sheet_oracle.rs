//! Tests both proofs against the oracle for sheets and prints the results by class.
//!
//! `cargo run --release -p foldmotion-verify --example sheet_oracle [SHEETS]`: the number of sheets (default: 100 000)
//! is divided among the classes. The exit status is 1 if a verdict was wrong.
//!
//! `--class NAME` tests one class only; `--number K` with it tests one scene, and `--write FILE.fold` writes that scene
//! as a motion.

#![expect(clippy::print_stdout, reason = "an example that prints its table")]
#![expect(clippy::disallowed_methods, reason = "the tests compare the two proofs")]

#[path = "../tests/sheet_oracle/oracle/mod.rs"]
#[expect(clippy::expect_used, reason = "the oracle is a test")]
mod oracle;

use std::{error::Error, fs::File, io::BufWriter, process::ExitCode, time::Instant};

use foldmotion_check::{CollisionOptions, collisions};
use foldmotion_pattern::FoldHeader;
use foldmotion_verify::verify;
use oracle::{
    class::Class,
    trial::{HEADER, Tally, motion_of, try_class, try_scene},
};

/// The command line.
#[derive(Default)]
struct Asked {
    sheets: Option<u64>,
    class: Option<Class>,
    number: Option<u64>,
    write: Option<String>,
}

fn asked() -> Result<Asked, Box<dyn Error>> {
    let mut asked = Asked::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--class" => {
                let name = value()?;
                asked.class = Some(Class::named(&name).ok_or(format!("no class {name}"))?);
            }
            "--number" => asked.number = Some(value()?.parse()?),
            "--write" => asked.write = Some(value()?),
            sheets => asked.sheets = Some(sheets.parse()?),
        }
    }
    Ok(asked)
}

fn write(class: Class, number: u64, file: &str) -> Result<(), Box<dyn Error>> {
    let (motion, _, _) = motion_of(class, number);
    let header = FoldHeader {
        title: &format!("{class:?} {number}"),
        creator: "foldmotion sheet_oracle",
        unit: "unit",
        target_angles: &vec![0.0; motion.sheet.edges.len()],
        layer_orders: &[],
        keys: &serde_json::Map::new(),
    };
    motion.write_fold(&header, &mut BufWriter::new(File::create(file)?))?;
    Ok(())
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let asked = asked()?;
    if let (Some(class), Some(number)) = (asked.class, asked.number) {
        println!("{:#?}", try_scene(class, number));
        let (motion, ..) = motion_of(class, number);
        let report = collisions(&motion, &CollisionOptions::default(), &|_| true)?;
        for penetration in &report.penetrations {
            println!("{penetration:?}");
        }
        for undecided in &report.undecided {
            println!("{undecided:?}");
        }
        println!("{:#?}", verify(&motion, &report));
        println!("{:?}", motion.sheet.faces);
        for frame in &motion.frames {
            println!("t = {}", frame.time);
            for (v, p) in frame.positions.iter().enumerate() {
                println!("  {v:>2}: {} {} {}", p.x, p.y, p.z);
            }
        }
        if let Some(file) = asked.write {
            write(class, number, &file)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let classes = asked.class.map_or(Class::ALL.to_vec(), |class| vec![class]);
    let share = asked.sheets.unwrap_or(100_000).div_ceil(classes.len() as u64);
    let start = Instant::now();
    println!("{HEADER}");
    let mut all = Tally::default();
    for class in classes {
        let tally = try_class(class, share);
        println!("{:<16} {tally}  {:.1} s", format!("{class:?}"), start.elapsed().as_secs_f64());
        for (what, numbers) in tally.lists() {
            if !numbers.is_empty() {
                let first: Vec<_> = numbers.iter().take(8).collect();
                println!("    {what}: {} {first:?}", numbers.len());
            }
        }
        all.add(&tally);
    }
    println!("{:<16} {all}", "all");
    Ok(ExitCode::from(u8::from(!all.missed.is_empty() || !all.false_alarms.is_empty())))
}
