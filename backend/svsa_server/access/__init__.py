"""Who may do what: doors that tell who comes, the permissions, the guard before all."""
