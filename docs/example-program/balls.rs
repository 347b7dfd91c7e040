// A collision library in Rust as a subject of Nearmiss, over pipes in binary; docs/reference/protocol.md explains each line.
//
//     rustc --edition 2021 -O -o balls docs/example-program/balls.rs   &&   ./nearmiss run --command ./balls --subject balls-rs
use std::fs::File;
use std::io::{BufReader, BufWriter, Error, Read, Write};
use std::os::unix::io::FromRawFd;

const HELLO: &str = r#"{"nearmiss": 3, "name": "balls-rs", "version": "1.0", "scalar": "double", "batches": "binary", "offers": [{"query": "sphere_sphere_overlap"}, {"query": "moving_point_sphere", "gives": ["time", "location"]}]}
"#;

enum Answer {
    No,
    Yes(Vec<f64>),
    Cannot(&'static str),
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: &[f64], b: &[f64]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn balls_meet(q: &[f64]) -> Answer {
    let (d, reach) = (minus(&q[0..3], &q[4..7]), q[3] + q[7]);
    if dot(d, d) <= reach * reach { Answer::Yes(vec![]) } else { Answer::No }
}

// The outputs are time, location and normal; the hello says that the normal is not given.
fn ray_meets_ball(q: &[f64]) -> Answer {
    let (v, w, radius) = ([q[3], q[4], q[5]], minus(&q[0..3], &q[6..9]), q[9]);
    let (a, b, c) = (dot(v, v), dot(w, v), dot(w, w) - radius * radius);
    if c < 0.0 || a == 0.0 {
        return Answer::Cannot("it starts inside, or does not move");
    }
    if b >= 0.0 || b * b < a * c {
        return Answer::No;
    }
    let t = c / ((b * b - a * c).sqrt() - b);
    Answer::Yes(vec![t, q[0] + v[0] * t, q[1] + v[1] * t, q[2] + v[2] * t, 0.0, 0.0, 0.0])
}

// The function of each offer, how many values it gives, and a bit for each of them.
const OFFERS: [(fn(&[f64]) -> Answer, usize, u64); 2] = [(balls_meet, 0, 0), (ray_meets_ball, 7, 0b1111)];

fn write_answer(to: &mut impl Write, answer: Answer, number: u32, outputs: usize, given: u64) -> Result<(), Error> {
    let (status, yes, why) = match &answer {
        Answer::No => (0, 0, ""),
        Answer::Yes(_) => (0, 1, ""),
        Answer::Cannot(why) => (1, 0, *why),
    };
    to.write_all(&[status, yes])?;
    to.write_all(&(why.len() as u16).to_ne_bytes())?;
    to.write_all(&number.to_ne_bytes())?;
    to.write_all(&given.to_ne_bytes())?;
    match answer {
        Answer::Cannot(why) => to.write_all(why.as_bytes()),
        Answer::Yes(values) => values.iter().try_for_each(|x| to.write_all(&x.to_ne_bytes())),
        Answer::No => to.write_all(&vec![0; 8 * outputs]),
    }
}

fn number_at(bytes: &[u8], i: usize) -> usize {
    u32::from_ne_bytes(bytes[4 * i..4 * i + 4].try_into().unwrap()) as usize
}

fn main() -> Result<(), Error> {
    let mut cases = BufReader::new(unsafe { File::from_raw_fd(3) });
    let mut answers = BufWriter::new(unsafe { File::from_raw_fd(4) });
    answers.write_all(HELLO.as_bytes())?;
    answers.flush()?;
    let mut head = [0; 16];
    while cases.read_exact(&mut head).is_ok() {
        let (offer, count, first) = (number_at(&head, 0), number_at(&head, 1), number_at(&head, 2));
        let mut lengths = vec![0; 4 * count];
        cases.read_exact(&mut lengths)?;
        let (answer, outputs, given) = OFFERS[offer];
        for i in 0..count {
            let mut bytes = vec![0; 8 * number_at(&lengths, i)];
            cases.read_exact(&mut bytes)?;
            let q: Vec<f64> = bytes.chunks(8).map(|b| f64::from_ne_bytes(b.try_into().unwrap())).collect();
            write_answer(&mut answers, answer(&q), (first + i) as u32, outputs, given)?;
        }
        answers.flush()?;
    }
    Ok(())
}
