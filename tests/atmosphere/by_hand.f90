! Runs the deck TAPE5 of the working folder and prints what LOWTRAN 7 computed: a run by hand.
program by_hand
  implicit none
  integer, parameter :: n = 12000
  real :: tx(n, 63), v(n), alam(n), trace(n), unif(n), suma(n), irrad(n, 3), sumvv(n), none(34)
  integer :: i
  v = 0.
  none = 0.
  call lwtrn7(.false., n, 0., 0., 0., tx, v, alam, trace, unif, suma, irrad, sumvv, &
              0, 0, 0, 0, 0, 0, 0, none, none, none, none, 0., 0., 0., 0.)
  do i = 1, n
    if (v(i) > 0.) print '(f9.1, 3es16.7)', v(i), tx(i, 1), sumvv(i), irrad(i, 3)
  end do
end program
