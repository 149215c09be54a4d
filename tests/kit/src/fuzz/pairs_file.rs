//! A line of a pairs file of any bytes is refused with a reason, or is a pair that can be solved or refused.

use super::whole::Whole;
use crate::pair_line;
use potential_particles::{Settings, detect};

pub fn run(data: &[u8]) {
    match pair_line::pair(data) {
        Ok(pair) => {
            if let Ok(contact) = detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &Settings::default(), None) {
                contact.assert_whole();
            }
        }
        Err(reason) => assert!(!reason.is_empty()),
    }
}
