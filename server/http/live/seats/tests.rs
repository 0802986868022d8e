use super::*;

const SECOND: Duration = Duration::from_secs(1);

/// A browser, or a program if it has no visitor.
fn guest(key: &str, visitor: Option<&str>) -> Guest {
    Guest { key: key.to_owned(), visitor: visitor.map(Arc::from) }
}

fn joined<const N: usize>(seats: &mut Seats, now: Instant) -> [u64; N] {
    std::array::from_fn(|_| {
        let key = seats.next.to_string();
        seats.join(guest(&key, None), now).unwrap()
    })
}

#[test]
fn the_first_browser_operates_and_requests_are_answered_in_their_order() {
    let now = Instant::now();
    let mut seats = Seats::new(now);
    let [one, two, three] = joined(&mut seats, now);
    assert_eq!((seats.operator, seats.epoch), (Some(one), 1));
    for own in [two, three, two] {
        seats.take(own, now).unwrap();
    }
    assert_eq!((seats.operator, &seats.asking), (Some(one), &[two, three].into()));
    seats.leave(one, now);
    assert_eq!((seats.operator, &seats.asking, seats.epoch), (Some(two), &[three].into(), 2));
    seats.release(two, now);
    seats.release(three, now);
    assert_eq!((seats.operator, seats.epoch), (None, 4));
    seats.take(two, now).unwrap();
    assert_eq!((seats.operator, seats.epoch, seats.viewers()), (Some(two), 5, 2));
    seats.take(two, now).unwrap();
    assert_eq!(seats.epoch, 5, "the browser has the seat already");
}

#[test]
fn only_an_idle_operator_loses_the_seat_and_the_next_one_is_asked_at_once() {
    let start = Instant::now();
    let later = |seconds| start + seconds * SECOND;
    let mut seats = Seats::new(start);
    let [one, two, three] = joined(&mut seats, start);
    seats.settle(later(1000));
    assert_eq!(seats.operator, Some(one), "no other browser requested the seat");
    seats.take(two, later(1000)).unwrap();
    seats.command(later(1020));
    seats.take(three, later(1049)).unwrap();
    seats.settle(later(1049));
    assert_eq!(seats.operator, Some(one));
    seats.settle(later(1050));
    assert_eq!((seats.operator, &seats.asking), (Some(two), &[three].into()));
    assert_eq!(seats.answers_within(later(1060)), Some(20 * SECOND));
    seats.release(three, later(1061));
    seats.settle(later(2000));
    assert_eq!((seats.operator, seats.answers_within(later(2000))), (Some(two), None));
}

#[test]
fn a_request_that_becomes_the_first_waits_as_long_as_any() {
    let start = Instant::now();
    let later = |seconds| start + seconds * SECOND;
    let mut seats = Seats::new(start);
    let [_, two, three] = joined(&mut seats, start);
    seats.take(two, later(100)).unwrap();
    seats.take(three, later(101)).unwrap();
    seats.release(two, later(120));
    assert_eq!(seats.answers_within(later(120)), Some(30 * SECOND));
}

#[test]
fn an_operator_who_keeps_control_is_not_asked_for_a_minute() {
    let start = Instant::now();
    let later = |seconds| start + seconds * SECOND;
    let mut seats = Seats::new(start);
    let [one, two] = joined(&mut seats, start);
    seats.keep(start);
    seats.take(two, later(100)).unwrap();
    assert_eq!(seats.answers_within(later(110)), Some(20 * SECOND));
    seats.keep(later(110));
    assert_eq!((seats.operator, seats.answers_within(later(111))), (Some(one), None));
    assert_eq!(seats.take(two, later(150)), Err(KeptFor(20 * SECOND)));
    seats.settle(later(169));
    assert_eq!(seats.operator, Some(one));
    seats.take(two, later(171)).unwrap();
    assert_eq!(seats.asking, [two]);
    // It belongs to the lease.
    seats.keep(later(172));
    seats.release(one, later(173));
    seats.take(one, later(174)).unwrap();
    seats.take(two, later(174)).unwrap();
    assert_eq!((seats.operator, &seats.asking), (Some(one), &[two].into()));
}

#[test]
fn a_page_that_loads_again_has_its_seat_again_and_nothing_else_does() {
    let start = Instant::now();
    let later = |seconds| start + seconds * SECOND;
    let mut seats = Seats::new(start);
    let anna = seats.join(guest("a", Some("anna")), start).unwrap();
    let bert = seats.join(guest("b", Some("bert")), start).unwrap();
    seats.take(bert, later(1)).unwrap();
    seats.leave(anna, later(2));
    assert!(seats.operator.is_none() && seats.is_held());
    assert_eq!(seats.answers_within(later(3)), Some(4 * SECOND));
    let carl = seats.join(guest("c", None), later(3)).unwrap();
    assert_eq!((seats.operator, &seats.asking), (None, &[bert, carl].into()));
    let anna = seats.join(guest("another page", Some("anna")), later(4)).unwrap();
    assert_eq!((seats.operator, &seats.asking), (Some(anna), &[bert, carl].into()));
    assert_eq!(seats.answers_within(later(4)), Some(30 * SECOND));
    // It does not come back.
    seats.leave(anna, later(5));
    seats.settle(later(9));
    assert_eq!(seats.operator, None);
    seats.settle(later(10));
    assert_eq!((seats.operator, &seats.asking), (Some(bert), &[carl].into()));
    // A page that connects again before its old connection is lost.
    let again = seats.join(guest("b", Some("bert")), later(11)).unwrap();
    seats.leave(bert, later(12));
    assert_eq!(seats.operator, Some(again));
    // A program that leaves does not come back.
    seats.release(again, later(13));
    seats.leave(carl, later(13));
    assert!(!seats.is_held());
}

#[test]
fn a_session_is_open_to_all_while_it_is_free_and_to_its_operator() {
    let now = Instant::now();
    let (anna, bert) = (Arc::from("anna"), Arc::from("bert"));
    let mut seats = Seats::new(now);
    let open = |seats: &Seats| [Some(&anna), Some(&bert), None].map(|visitor| seats.is_open_to(visitor));
    assert_eq!(open(&seats), [true; 3]);
    let own = seats.join(guest("a", Some("anna")), now).unwrap();
    assert_eq!(open(&seats), [true, false, false]);
    seats.leave(own, now);
    assert_eq!(open(&seats), [true, false, false], "it may be loading again");
    seats.settle(now + RETURN_WITHIN);
    assert_eq!(open(&seats), [true; 3]);
    let [_] = joined(&mut seats, now);
    assert_eq!(open(&seats), [false; 3], "a program has it");
}

#[test]
fn only_a_session_that_nothing_steers_closes() {
    let start = Instant::now();
    let later = |seconds| start + seconds * SECOND;
    let mut seats = Seats::new(start);
    let [one, two] = joined(&mut seats, start);
    assert!(!seats.close_if_unsteered(60 * SECOND, later(1000)));
    seats.release(one, later(1000));
    assert!(!seats.close_if_unsteered(60 * SECOND, later(1059)));
    assert_eq!(seats.unsteered_for(later(1059)), 59 * SECOND);
    seats.take(two, later(1059)).unwrap();
    assert!(!seats.close_if_unsteered(60 * SECOND, later(1060)));
    seats.leave(two, later(1060));
    assert!(seats.close_if_unsteered(60 * SECOND, later(1120)));
    assert_eq!(seats.join(guest("late", None), later(1120)), Err(NoSeat::Closed));
}

#[test]
fn the_number_of_browsers_is_limited() {
    let now = Instant::now();
    let mut seats = Seats::new(now);
    let all: [u64; VIEWERS] = joined(&mut seats, now);
    assert_eq!(seats.join(guest("late", None), now), Err(NoSeat::Full));
    seats.leave(all[VIEWERS - 1], now);
    let next = seats.join(guest("late", None), now);
    assert!(next.is_ok_and(|next| next > all[VIEWERS - 1]), "no number is given twice");
}
